"""An FMU's description as a document: every variable, numbers as numbers."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from types import MappingProxyType

from pyjoystick.fmu import description_json, read_description


def test_every_variable_is_there(joystick_path: Path) -> None:
    description = read_description(joystick_path)
    document = json.loads(description_json(description))
    assert document["fmu"]["path"] == str(joystick_path)
    assert document["fmu"]["guid"] == description.guid
    assert [one["name"] for one in document["variables"]] == list(description.variables)
    (mass,) = (one for one in document["variables"] if one["name"] == "m")
    assert (mass["start"], mass["unit"], mass["causality"]) == (0.87, "kg", "parameter")
    assert (mass["minimum"], mass["exclusive_minimum"], mass["maximum"]) == (0.0, True, None)


def test_start_values_are_exact_numbers_or_as_they_are_written(joystick_path: Path) -> None:
    description = read_description(joystick_path)
    mass = description.variables["m"]
    starts = {
        ("Int64", "9007199254740993"): 9007199254740993,
        ("Real", "-1.5e-3"): -0.0015,
        ("Float64", "1.0 2.0"): "1.0 2.0",
        ("Real", "INF"): None,
        ("String", "12"): "12",
        ("Boolean", "true"): "true",
        ("Real", None): None,
    }
    for (kind, start), expected in starts.items():
        variables = MappingProxyType({"m": dataclasses.replace(mass, type=kind, start=start)})
        document = json.loads(description_json(dataclasses.replace(description, variables=variables)))
        (found,) = document["variables"]
        assert found["start"] == expected
        assert type(found["start"]) is type(expected)
