"""What the FMUs in ``sensitivities/`` compute: for this package, ``make fmu``, which runs it, and the wheel.

Imports nothing of this project: a wheel is built where its dependencies are not installed.
"""

from __future__ import annotations

from types import MappingProxyType

#: Requests by the name of the FMU: by start values for periodic motions, by parameters for fits. Each
#: parameter more makes every run of the FMU longer.
SENSITIVITIES = MappingProxyType(
    {
        "Joystick": "theta,omega:theta_start,omega_start,damping.C,J",
        "JoystickPowerLaw": "theta,omega:theta_start,omega_start,damping.A_pos,damping.n_pos,damping.A_neg,"
        "damping.n_neg,damping.B,damping.m,J",
    }
)

if __name__ == "__main__":
    print(*(f"{name}={request}" for name, request in SENSITIVITIES.items()), sep="\n")
