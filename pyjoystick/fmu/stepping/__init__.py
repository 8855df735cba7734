"""The loop over the steps of a run, using the C functions of an FMU.

`kernel` is plain Python that runs unchanged through ctypes, and that `compiled` compiles to machine code with
Numba. Having one source, both give bitwise equal results.
"""
