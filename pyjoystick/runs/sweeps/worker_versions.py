"""Whether the workers of a cluster are made like this machine."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from pyjoystick.runs.errors import ClusterError

#: Where these differ, the last digits of results may.
_NUMERICAL: Final = ("Python", "numpy", "scipy")


def check_workers(client: Any, address: str, on_note: Callable[[str], None]) -> None:
    """Compare the versions on every worker with those here.

    Args:
        client: a connected ``distributed.Client``
        address: of its scheduler, for messages
        on_note: told of versions that differ without being fatal

    Raises:
        ClusterError: there are no workers, or one lacks pyjoystick or has another version of it
    """
    here = _versions_function()()
    found: dict[str, dict[str, str]] = client.run(_versions_function())
    if not found:
        raise ClusterError(address, "has no workers; start some with `dask worker ADDRESS`")
    for worker, there in found.items():
        if there["pyjoystick"] != here["pyjoystick"]:
            reason = f"worker {worker} has pyjoystick {there['pyjoystick']}, here is {here['pyjoystick']}"
            raise ClusterError(address, f"{reason}; the same version must be installed on all")
        differing = [name for name in _NUMERICAL if there[name] != here[name]]
        if differing:
            pairs = ", ".join(f"{name} {there[name]} (here {here[name]})" for name in differing)
            on_note(f"worker {worker} has {pairs}: its results may differ in the last digits")
        if there["numba"] == "not installed":
            on_note(f"worker {worker} has no numba and is slow: pip install 'pyjoystick[fast]' there")


def _versions_function() -> Any:
    # A function within a function is sent as code, so that it runs where pyjoystick is not installed.
    def versions() -> dict[str, str]:
        import platform
        from importlib import metadata
        from importlib.util import find_spec

        def version(package: str) -> str:
            try:
                return metadata.version(package)
            except metadata.PackageNotFoundError:
                return "not installed"

        packages = ("numpy", "scipy", "numba")
        found = {name: version(name) for name in packages} | {"Python": platform.python_version()}
        # From a bare checkout it can be imported without being installed.
        is_there = find_spec("pyjoystick") is not None
        found["pyjoystick"] = version("pyjoystick") if is_there else "not installed at all"
        return found

    return versions
