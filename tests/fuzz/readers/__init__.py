"""Whatever is done to a file, reading it works or ends in an error that says what is wrong.

``make fuzz SECONDS=...`` damages valid files of every kind that the project reads and drives the readers and
the commands with them, for so long; the tests try a fixed number. A case is its number: it can be repeated.
"""
