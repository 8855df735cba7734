"""The memory of this process."""

from __future__ import annotations

from pathlib import Path


def memory_of_process(what: str) -> float | None:
    """Return current (VmRSS) or peak (VmHWM) memory of this process (MiB); None if there is no /proc."""
    status = Path("/proc/self/status")
    if not status.is_file():
        return None
    lines = [line.split() for line in status.read_text().splitlines() if line.startswith(f"{what}:")]
    return int(lines[0][1]) / 1024.0 if lines else None


def reset_peak() -> None:
    """Reset VmHWM to the current memory, if there is a /proc."""
    clear = Path("/proc/self/clear_refs")
    if clear.is_file():
        clear.write_text("5")
