"""The low-pass filter of section 2: Butterworth, applied forward and backward.

The delays of both passes cancel: the phase is zero, and the amplitude is filtered twice. With a Butterworth
filter of order n, the amplitude response is 1/(1 + (f/f_c)^(2n)): two passes of fourth order fall off like an
eighth order, by 48 dB per octave. At f_c it is one half, -6 dB; the -3 dB point is at
(sqrt(2) - 1)^(1/(2n)) f_c, which is 11.64 Hz for 13 Hz and n = 4. (For a digital filter, f stands for
tan(pi f/f_s): at 600 Hz this changes the fourth digit.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyjoystick.support import FloatArray, ParameterError, SeriesError, positive, whole_number

#: Both ends are extended by this many periods of the cut-off, by rotation about the end point.
_PROLONGED = 6.0


@dataclass(frozen=True, slots=True)
class LowPass:
    """A Butterworth low-pass filter applied forward and backward.

    Attributes:
        cutoff: cut-off frequency (Hz); the -3 dB point of a single pass, unless `corrected`
        order: order of a single pass, 1 to 10
        corrected: whether the cut-off is raised so that both passes together are at -3 dB at `cutoff`

    Raises:
        ParameterError: a value is outside its range
    """

    cutoff: float = 13.0
    order: int = 4
    corrected: bool = False

    def __post_init__(self) -> None:
        positive("cutoff", self.cutoff, "Hz")
        whole_number("order", self.order, 1, 10)

    def design_cutoff(self, rate: float) -> float:
        """Cut-off of a single pass (Hz) for samples at `rate` (Hz)."""
        self._require_below_half(rate)
        if not self.corrected:
            return self.cutoff
        warped = math.tan(math.pi * self.cutoff / rate) / _fall(self.order)
        return rate / math.pi * math.atan(warped)

    def half_power_frequency(self, rate: float) -> float:
        """Frequency at which both passes together are at -3 dB (Hz)."""
        warped = math.tan(math.pi * self.design_cutoff(rate) / rate) * _fall(self.order)
        return rate / math.pi * math.atan(warped)

    def response(self, frequency: FloatArray, rate: float) -> FloatArray:
        """Amplitude response of both passes at frequencies (Hz) of any shape, for samples at `rate` (Hz)."""
        cutoff = math.tan(math.pi * self.design_cutoff(rate) / rate)
        ratio = np.tan(math.pi * np.asarray(frequency) / rate) / cutoff
        return np.asarray(1.0 / (1.0 + ratio ** (2 * self.order)), dtype=np.float64)

    def filter(self, values: FloatArray, rate: float) -> FloatArray:
        """Filter samples of shape (n,) at `rate` (Hz) forward and backward.

        Raises:
            ParameterError: the cut-off is not below half of the rate
            SeriesError: too few samples, or some are NaN or infinite
        """
        cutoff = self.design_cutoff(rate)
        if len(values) < 2 * self.order + 2:
            reason = f"has {len(values)} samples, at least {2 * self.order + 2} are needed"
            raise SeriesError("values", reason)
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            raise SeriesError("values", f"sample {bad[0]} is {values[bad[0]]}")
        # SciPy is slow to load, and not needed for the settings of a filter alone.
        from scipy import signal

        sections = signal.butter(self.order, cutoff, fs=rate, output="sos")
        padding = min(len(values) - 1, math.ceil(_PROLONGED * rate / cutoff))
        return np.asarray(signal.sosfiltfilt(sections, values, padlen=padding), dtype=np.float64)

    def _require_below_half(self, rate: float) -> None:
        if not self.cutoff < rate / 2.0:
            raise ParameterError("cutoff", self.cutoff, f"below half of the sampling rate, {rate / 2.0:g} Hz")


def _fall(order: int) -> float:
    """Frequency of -3 dB of two passes, relative to the cut-off of one."""
    return float((math.sqrt(2.0) - 1.0) ** (1.0 / (2 * order)))
