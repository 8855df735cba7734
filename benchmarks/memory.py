"""The memory of this process."""

from __future__ import annotations

from pathlib import Path


def memory_of_process(what: str) -> float | None:
    """Present (VmRSS) or greatest (VmHWM) memory of this process (MiB); None where there is no /proc."""
    status = Path("/proc/self/status")
    if not status.is_file():
        return None
    lines = [line.split() for line in status.read_text().splitlines() if line.startswith(f"{what}:")]
    return int(lines[0][1]) / 1024.0 if lines else None


def reset_peak() -> None:
    """Has VmHWM begin anew at the present memory, where there is a /proc."""
    clear = Path("/proc/self/clear_refs")
    if clear.is_file():
        clear.write_text("5")
