"""Script: read the numbers in a MATLAB file, which crashes scipy or HDF5 if it is damaged in some ways.

Usage: python matlab_script.py FORM FILE    The form is ``matlab`` or ``matlab 7.3``. The variables, with
structures as dictionaries, are written to the standard output by pickle. Exit code 1 and a line on the
standard error if the file cannot be read.
"""

from __future__ import annotations

import pickle
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np


def variables_of(form: str, file: str) -> dict[str, Any]:
    """Return the variables of a file that are numbers; whatever the packages raise propagates."""
    if form == "matlab 7.3":
        import h5py

        with h5py.File(file) as opened:
            return _of_group(opened, h5py.Group)
    from scipy.io import loadmat

    return _of_structure(loadmat(file, simplify_cells=True))


def _of_structure(found: Mapping[str, Any]) -> dict[str, Any]:
    numbers: dict[str, Any] = {}
    for name, value in found.items():
        if isinstance(value, Mapping):
            numbers[name] = _of_structure(value)
        elif not name.startswith("__") and np.asarray(value).dtype.kind in "iufb":
            numbers[name] = np.asarray(value)
    return numbers


def _of_group(group: Any, kind: type) -> dict[str, Any]:
    numbers: dict[str, Any] = {}
    for name, one in group.items():
        if isinstance(one, kind):
            numbers[name] = _of_group(one, kind) if not name.startswith("#") else {}
        elif one.dtype.kind in "iufb" and one.attrs.get("MATLAB_class", b"double") != b"char":
            numbers[name] = np.squeeze(one[()].T)
    return numbers


if __name__ == "__main__":
    try:
        pickle.dump(variables_of(*sys.argv[1:]), sys.stdout.buffer)
    except Exception as error:  # packages raise many types for damaged files
        sys.exit(f"{error}" or type(error).__name__)
