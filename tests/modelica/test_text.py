"""The library's form: one class per file, descriptions, documentation, icons."""

from __future__ import annotations

import re

import pytest

from tests.modelica.library import (
    MSL_ROOT,
    ROOT,
    LibraryClass,
    comparison_signals,
    examples,
    flat_variables,
    library_classes,
    msl_examples,
    split_statements,
    without_annotations,
)

CLASSES = {c.qualified: c for root in (ROOT, MSL_ROOT) for c in library_classes(root)}
#: Names of the Modelica Standard Library, in which nothing is looked up here.
STANDARD = "Modelica."


def _packages() -> list[LibraryClass]:
    return [c for c in CLASSES.values() if c.kind == "package" and c.file.name == "package.mo"]


@pytest.mark.parametrize("package", _packages(), ids=lambda c: c.qualified)
def test_package_order_names_exactly_the_classes_that_exist(package: LibraryClass) -> None:
    listed = (package.file.parent / "package.order").read_text().split()
    files = {f.stem for f in package.file.parent.glob("*.mo")} - {"package"}
    folders = {f.name for f in package.file.parent.iterdir() if (f / "package.mo").is_file()}
    assert len(listed) == len(set(listed))
    assert set(listed) == files | folders


@pytest.mark.parametrize("name", CLASSES)
def test_a_file_holds_one_class_of_its_name_within_its_folder(name: str) -> None:
    found = CLASSES[name]
    code = found.code
    classes = re.findall(
        r"^\s*(?:partial )?(?:package|model|block|connector|type|class|function) (\w+)", code, re.M
    )
    assert classes == [name.rpartition(".")[2]]
    parent = name.rpartition(".")[0]
    assert code.startswith(f"within {parent};\n" if parent else "package ")


@pytest.mark.parametrize("name", CLASSES)
def test_every_class_has_documentation(name: str) -> None:
    information = re.search(
        r'Documentation\(info = "<html>\n(.*?)\n</html>"\)', CLASSES[name].text, re.DOTALL
    )
    assert information
    assert len(re.sub(r"<[^>]*>", "", information[1]).strip()) > 10


@pytest.mark.parametrize("name", [n for n, c in CLASSES.items() if c.kind != "type"])
def test_every_class_that_is_drawn_has_an_icon(name: str) -> None:
    assert _has_icon(CLASSES[name])


def _has_icon(found: LibraryClass) -> bool:
    if re.search(r"Icon\(coordinateSystem\([^)]*\), graphics = \{\s*\w", found.text):
        return True
    bases = re.findall(r"^  extends ([\w.]+)", found.code, re.M)
    return any(base.startswith(STANDARD) or _has_icon(_resolve(base, found)) for base in bases)


def _resolve(name: str, user: LibraryClass) -> LibraryClass:
    """The class that a name means inside another class, looked up from the inside out."""
    scope = user.qualified
    while scope:
        if f"{scope}.{name}" in CLASSES and f"{scope}.{name}" != user.qualified:
            return CLASSES[f"{scope}.{name}"]
        scope = scope.rpartition(".")[0]
    return CLASSES[name]


@pytest.mark.parametrize("name", CLASSES)
def test_every_declaration_has_a_description(name: str) -> None:
    header = split_statements(CLASSES[name].code)[1]
    assert re.search(r'[\s)]"[^"=]{3,}"$', header.strip()), header
    for declaration in CLASSES[name].declarations:
        assert re.search(r'\s"[^"]{3,}"$', declaration), declaration


def test_descriptions_are_looked_for_where_they_belong() -> None:
    """The check above must see declarations, and must not be satisfied by other strings."""
    assert sum(len(c.declarations) for c in CLASSES.values()) > 100
    spring = CLASSES["PreloadedSprings.Springs.RestrainedPreloadedSpring"]
    assert [d.split('"')[0].split("(")[0].split(" = ")[0].split()[-1] for d in spring.declarations] == [
        "k_s", "k_h", "F_0", "x_0", "delta", "isEngaged", "isReleased",
    ]  # fmt: skip
    assert without_annotations('Real x "a" annotation (Dialog(group = "b (c")); y') == 'Real x "a" ; y'


@pytest.mark.parametrize("name", CLASSES)
def test_every_component_of_a_diagram_is_placed_and_every_connection_drawn(name: str) -> None:
    text = CLASSES[name].text
    connections = re.findall(r"connect\([^)]*\)\s*(annotation \(Line\(points = )?", text)
    assert all(connections)
    for statement in re.findall(
        r"^  (?!parameter|constant|final|extends)[A-Z][\w.]* \w+(?:\[[^\]]*\]|[^;])*;", text, re.M
    ):
        type_name = statement.split()[0]
        if not type_name.startswith(("Units.", "SI.")) and type_name not in ("Boolean", "Integer"):
            assert "Placement(" in statement, statement


def test_the_library_uses_no_other_library() -> None:
    """Names of the Modelica Standard Library occur in texts for the reader only."""
    for found in library_classes(ROOT):
        code = re.sub(r'"(?:[^"\\]|\\.)*"', "", found.text)
        assert not re.search(r"\bModelica\b|\buses\b", code), found.file


def test_libraries_say_their_version_and_what_they_use() -> None:
    for found in (CLASSES["PreloadedSprings"], CLASSES["PreloadedSpringsMSL"]):
        for attribute in ('preferredView = "info"', "version =", "versionDate ="):
            assert attribute in found.text, found.name
    used = re.search(r"uses\((.*)\)", CLASSES["PreloadedSpringsMSL"].text)
    assert used
    own = re.search(r'version = "([^"]*)"', CLASSES["PreloadedSprings"].text)
    assert own
    assert f'PreloadedSprings(version = "{own[1]}")' in used[1]
    assert "Modelica(version = " in used[1]


@pytest.mark.parametrize("example", examples())
def test_comparison_signals_are_variables(example: str) -> None:
    assert set(comparison_signals(example)) <= set(flat_variables(example))


def test_examples_and_comparison_signals_are_the_same() -> None:
    for root in (ROOT, MSL_ROOT):
        files = (root / "Resources" / "Reference").rglob("comparisonSignals.txt")
        found = {".".join(file.parts[file.parts.index("Reference") + 1 : -1]) for file in files}
        assert found == set(examples() if root == ROOT else msl_examples())


def test_texts_of_icons_have_the_attribute_of_texts() -> None:
    """Modelica 3.4: the color of a Text is its textColor, no longer its lineColor."""
    for found in CLASSES.values():
        assert not re.search(r"\bText\([^()]*\blineColor", found.text), found.file


def test_links_of_the_documentation_lead_somewhere() -> None:
    links = [
        (found.file, link)
        for found in CLASSES.values()
        for link in re.findall(r"modelica://([\w.]+)", found.text)
    ]
    assert len(links) > 30
    assert [link for link in links if link[1] not in CLASSES and not f"{link[1]}.".startswith(STANDARD)] == []


def test_kinks_are_relations() -> None:
    """Functions that hide a kink from the event detection occur in one assertion only.

    And in dry friction: where the motion is prescribed, nothing is integrated, and a sample at rest is at
    rest exactly; where it is computed, a motion against the mode is one of trial steps, before the event.
    """
    for found in CLASSES.values():
        if found.name in ("Friction.Prescribed", "Friction.StickSlip"):
            continue
        code = re.sub(r'"(?:[^"\\]|\\.)*"|\bassert\(noEvent\(abs\(theta\) < theta_limit\)', "", found.code)
        assert not re.search(r"\b(noEvent|smooth|abs|sign|min|max)\(", code), found.file


def test_files_are_short() -> None:
    for file in (*ROOT.rglob("*.mo"), *MSL_ROOT.rglob("*.mo")):
        lines = file.read_text().splitlines()
        assert len(lines) <= 300, file
        assert max(map(len, lines)) <= 120, file
