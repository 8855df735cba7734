"""The live page in a notebook."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pyjoystick import model
from pyjoystick.fmu import find_fmu
from pyjoystick.motion import DisplayUnit, Quantity, Record
from pyjoystick.reports.live_page.joystick_page import held_fmu, joystick_page, page_settings
from pyjoystick.support import MissingPackageError, angle, whole_number

if TYPE_CHECKING:
    from fmu_build.explore.model import PageVariable
    from pyjoystick.reports.live_page.widget import JoystickWidget


def explore(
    joystick: model.JoystickParameters | model.ParameterFile = model.NOMINAL,
    *,
    release_angle: float = -model.STOP_ANGLE,
    records: Sequence[Record] = (),
    title: str = "",
    height: int = 900,
) -> JoystickWidget:
    """Show a live joystick in the output of a notebook's cell: the page of ``pyjoystick explore``.

    Args:
        joystick: initial values of the page; a parameter file also gives title and handle
        release_angle: initial angle (rad)
        records: measured free oscillations, drawn over the simulated ones
        title: heading; by default that of the file
        height: height of the output (pixels)

    Returns:
        a widget with the page; its traits ``values`` and ``results`` are those of the page

    Raises:
        MissingPackageError: anywidget is not installed
        ParameterError: the angle is pi/2 or more, or the height is below 100
        FmuNotFoundError: the FMU is neither installed nor built
        BuildError: the FMU cannot be used, see `fmu_build.explore.explore_page`
    """
    start = angle("release_angle", release_angle)
    whole_number("height", height, 100)
    try:
        from pyjoystick.reports.live_page.widget import JoystickWidget
    except ImportError as error:
        raise MissingPackageError("pages in notebooks", "notebook") from error
    from fmu_build.explore import page_model  # slow to load

    file = joystick if isinstance(joystick, model.ParameterFile) else model.PAPER
    parameters = file.joystick if isinstance(joystick, model.ParameterFile) else joystick
    fmu = find_fmu(held_fmu(parameters))
    page = joystick_page(fmu, file, parameters, start, records=records, title=title)
    variables = page_model(fmu).variables
    given = page_settings(parameters, start, title).values
    values = {
        one.name: given.get(one.name, one.start)
        for one in variables
        if one.settable and one.kind == "r" and one.start is not None
    }
    return JoystickWidget(page, parameters, values, [_quantity(one) for one in variables], height)


def _quantity(one: PageVariable) -> Quantity:
    shown = DisplayUnit(one.display_unit, one.factor, one.offset) if one.display_unit != one.unit else None
    return Quantity(one.name, one.unit, shown, one.text)
