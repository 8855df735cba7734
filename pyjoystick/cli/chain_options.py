"""Options of the signal chain that the imports share."""

from __future__ import annotations

from typing import Annotated

import typer

from pyjoystick.laboratory import Chain, LowPass

Rate = Annotated[float, typer.Option("--rate", metavar="HZ", help="Samples a second after interpolation.")]
Cutoff = Annotated[float, typer.Option("--cutoff", metavar="HZ", help="Cut-off of the Butterworth filter.")]
Order = Annotated[int, typer.Option("--order", metavar="N", help="Order of one run of the filter.")]
Corrected = Annotated[
    bool,
    typer.Option("--corrected", help="Raise the cut-off so that both runs together are at -3 dB there."),
]
LongestGap = Annotated[
    float,
    typer.Option("--longest-gap", metavar="SECONDS", help="Longest time between frames that is bridged."),
]
VelocityPoints = Annotated[
    int, typer.Option("--velocity-points", metavar="N", help="Points of the first derivative: 3, 5 or 7.")
]
AccelerationPoints = Annotated[
    int,
    typer.Option("--acceleration-points", metavar="N", help="Points of the second derivative: 3, 5 or 7."),
]

PAPER = Chain()


def chain_of(
    rate: float,
    cutoff: float,
    order: int,
    corrected: bool,
    longest_gap: float,
    velocity: int,
    acceleration: int,
) -> Chain:
    """The chain of these options; raises ParameterError."""
    return Chain(rate, LowPass(cutoff, order, corrected), velocity, acceleration, longest_gap)
