import dataclasses

import pytest

from pyjoystick.fmu import find_fmu, read_description
from pyjoystick.identification.fitting.problem.ties import Ties
from pyjoystick.support import ParameterError


@pytest.mark.usefixtures("fmus_by_name")
def test_a_name_is_that_of_the_fmu_and_not_of_a_constant() -> None:
    """A parameter e, beside the e of a number and that of the interpreter's constants."""
    description = read_description(find_fmu("Joystick"))
    variables = {**description.variables, "e": description.variables["h"]}
    description = dataclasses.replace(description, variables=variables)
    for free in ("e", "J"):
        tied = Ties([free], {"m": f"2e-1 * {free}"}, description)
        assert tied.values([3.0]) == [pytest.approx(0.6)]
    with pytest.raises(ParameterError, match=r"ties\.m = e \* J: .*parameters: J \(e is not free\)"):
        Ties(["J"], {"m": "e * J"}, description)
