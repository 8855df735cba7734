"""What runs take where nothing else is said; apart, so that it can be had without what runs FMUs."""

from __future__ import annotations

from typing import Final

#: Tolerance that an FMU's integrator is asked to keep.
DEFAULT_TOLERANCE: Final = 1e-8
#: Length of a free oscillation (s): the joystick of the paper has come to rest by then.
DEFAULT_DURATION: Final = 1.5
#: Time between two rows of a table (s).
DEFAULT_OUTPUT_INTERVAL: Final = 1e-3
