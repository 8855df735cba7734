"""The runtime held against the tables and rules of the standards, which are written down here anew."""
