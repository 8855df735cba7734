"""From a laboratory's files to motions: motion capture, accelerometer, and effects of the processing."""
