"""A damaged table is read as a careful human reads it, or refused, or read with a note on the damage.

The readers of `tests.fuzz.readers` may return anything but an internal error. Here the content is known:
tables are written as instruments and people in several countries write them, then damaged so that a human
can see it. What is returned without a note must be samples that the table was written with.
"""
