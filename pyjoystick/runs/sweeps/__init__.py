"""Sweeps: many runs of an FMU over parameters, on the cores of this machine or a Dask cluster."""
