"""The loop over the steps of a run, on the C functions of an FMU.

`kernel` is plain Python that runs as it stands, through ctypes, and that `compiled` has Numba turn into
machine code. One source, so both give the same numbers, bit for bit.
"""
