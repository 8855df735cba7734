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
    """A joystick live in the output of a notebook's cell: the page of ``pyjoystick explore``.

    Args:
        joystick: the values that the page starts with; a parameter file gives title and handle too
        release_angle: angle at the start (rad)
        records: measured free oscillations, drawn over the simulated ones
        title: heading; that of the file by default
        height: of the output (pixels)

    Returns:
        a widget that shows the page; its traits ``values`` and ``results`` are what the page shows

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
    from fmu_build.explore import page_model  # takes long to load

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
