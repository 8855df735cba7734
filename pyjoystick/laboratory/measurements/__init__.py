"""From a laboratory's own files to motions: motion capture, accelerometer, and what the processing does."""
