"""The runtime against the tables and rules of the standards, transcribed here independently."""
