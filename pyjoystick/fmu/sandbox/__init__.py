"""Sandbox for untrusted FMUs: runs their WebAssembly module without access to files, network or processes.

`module` extracts the module from an FMU, and `machine` is one instance of it in wasmtime, with limits on
memory, instructions (fuel) and time. `pool` keeps machines; `runner` executes the runs of a plan, each as
a `run`, and `exchange` converts data. The module is treated as hostile: everything it returns is checked
before it is used as an address, a size or a value.
"""
