"""Sensitivities computed by the FMUs in ``sensitivities/``.

This package, the build of the wheel and ``make fmu``, which runs this module, use them. The module imports
nothing from this project, because a wheel is built without the project's dependencies.
"""

from __future__ import annotations

from types import MappingProxyType

#: Requests by the name of the FMU: with respect to start values for periodic motions, and to parameters for
#: fits. Each additional parameter makes every run of the FMU longer.
SENSITIVITIES = MappingProxyType(
    {
        "Joystick": "theta,omega:theta_start,omega_start,damping.C,J",
        "JoystickPowerLaw": "theta,omega:theta_start,omega_start,damping.A_pos,damping.n_pos,damping.A_neg,"
        "damping.n_neg,damping.B,damping.m,J",
    }
)

if __name__ == "__main__":
    print(*(f"{name}={request}" for name, request in SENSITIVITIES.items()), sep="\n")
