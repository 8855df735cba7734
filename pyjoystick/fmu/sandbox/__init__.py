"""FMUs from strangers: run by the WebAssembly module in them, which reaches no file, network or process.

`module` takes the module out of an FMU, `machine` is one instance of it in wasmtime, with bounded memory,
fuel and time. `pool` keeps machines; `runner` has them do the runs of a plan, each of which is a `run`, and
`exchange` translates. The module is taken for hostile: what it returns is checked before it is used as an
address, a size or a value.
"""
