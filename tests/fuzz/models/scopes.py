"""Meaning of names in random models: records passed on, packages, outer components, redeclarations."""

from __future__ import annotations

from typing import Any, Final

from tests.fuzz.models.functions import random_function
from tests.fuzz.models.terms import Scope, Term, Terms
from tests.fuzz.models.writer import Writer

#: Names on which the values of parameters may depend.
CONSTANT: Final = Scope(reals=("p1", "p2", "q1"), integers=("n1",), booleans=("b1",))


def handed_on(w: Writer) -> None:
    """Add a record of parameters that is passed as a whole through two components."""
    first = Terms(w.random, Scope(reals=("stiffness",))).real(1)
    body = Terms(w.random, Scope(reals=("data.stiffness", "data.loss", "u", "time"))).real(2)
    # A value that another one replaces is refused.
    inside = w.random.choice((*[""] * 8, "(stiffness = 7)", "(loss = 8)"))
    w.package.append(
        f"  record Law\n    Real stiffness = 1.5;\n    Real loss = {first.text};\n  end Law;\n"
        f"  model Inside\n    parameter Law data{inside};\n    Real u;\n    Real y;\n  equation\n"
        f"    y = {body.text};\n  end Inside;\n"
        f"  model Outside\n    parameter Law data;\n    Inside inside(data = data);\n  end Outside;"
    )
    stiffness, loss, u = w.terms(CONSTANT).real(1), w.terms(CONSTANT).real(1), w.terms().real(1)
    given = w.random.random() < 0.5
    w.declarations += [
        f"parameter Law law(stiffness = {stiffness.text}{f', loss = {loss.text}' if given else ''});",
        "Outside outside(data = law);",
    ]
    w.equations.append(f"outside.inside.u = {u.text};")

    def value(v: dict[str, Any]) -> float:
        own = {"data.stiffness": stiffness.value(v), "u": u.value(v), "time": v["time"]}
        own["data.loss"] = loss.value(v) if given else first.value({"stiffness": own["data.stiffness"]})
        return body.value(own)

    w.meaning.steps.append(("outside.inside.y", value))
    w.observed.append("outside.inside.y")
    w.scope = w.scope.more(reals=("outside.inside.y",))


def constants(w: Writer) -> None:
    """Add a package with constants, one of which depends on the others."""
    a, n = round(w.random.uniform(-2, 2), 2), w.random.randint(1, 4)
    row = [round(w.random.uniform(-2, 2), 2) for _ in range(3)]
    whole = Terms(w.random, Scope(reals=("a",), integers=("n",), vectors=("row",))).real(1)
    w.package.append(
        f"  package Given\n    constant Real a = {a};\n    constant Integer n = {n};\n"
        f"    constant Real row[3] = {{{', '.join(map(str, row))}}};\n"
        f"    constant Real whole = {whole.text};\n  end Given;"
    )
    known = {"a": a, "n": n, "row": row}
    known |= {"whole": whole.value(known)}
    names = {f"Given.{name}": value for name, value in known.items()} | {
        f"Given.row[{i + 1}]": one for i, one in enumerate(row)
    }
    reals = ("Given.a", "Given.whole", "Given.row[1]", "Given.row[3]", "time")
    body = Terms(w.random, Scope(reals=reals, integers=("Given.n",), vectors=("Given.row",))).real(3)
    w.add("from_package", Term(body.text, lambda v: body.value({**names, "time": v["time"]})))


def surrounded(w: Writer) -> None:
    """Add an inner component, to which a component two levels further down refers as outer."""
    field = Terms(w.random, Scope(reals=("g", "time"))).real(2)
    body = Terms(w.random, Scope(reals=("world.g", "world.field", "s", "time"))).real(2)
    w.package.append(
        f"  model World\n    parameter Real g = 9;\n    Real field;\n  equation\n    field = {field.text};\n"
        "  end World;\n"
        "  model Leaf\n    outer World world;\n    parameter Real s = 1;\n    Real y;\n  equation\n"
        f"    y = {body.text};\n  end Leaf;\n"
        "  model Branch\n    parameter Real r = 2;\n    Leaf leaf(s = 2*r);\n  end Branch;"
    )
    g, r = w.terms(CONSTANT).real(1), w.terms(CONSTANT).real(1)
    w.declarations += [f"inner World world(g = {g.text});", f"Branch branch(r = {r.text});"]

    def value(v: dict[str, Any]) -> float:
        own = {"world.g": g.value(v), "s": 2 * r.value(v), "time": v["time"], "world.field": v["world.field"]}
        return body.value(own)

    w.meaning.steps += [
        ("world.field", lambda v: field.value({"g": g.value(v), "time": v["time"]})),
        ("branch.leaf.y", value),
    ]
    w.observed += ["world.field", "branch.leaf.y"]
    w.scope = w.scope.more(reals=("branch.leaf.y",))


def cells(w: Writer) -> None:
    """Add an array of components with arrays, modified by comprehensions, and use some of its members."""
    body = Terms(w.random, Scope(reals=("k", "u", "time"), integers=("i",))).real(2)
    w.package.append(
        "  model Cell\n    parameter Real k = 1;\n    Real u;\n    Real x[2];\n  equation\n"
        f"    for i in 1:2 loop x[i] = {body.text}; end for;\n  end Cell;"
    )
    first = w.random.choice((*[1] * 8, 2))
    k = Terms(w.random, CONSTANT.more(integers=("j",))).real(1)
    u = w.terms().real(1)
    w.declarations.append(f"Cell cells[3](k = {{{k.text} for j in {first}:{first + 2}}});")
    w.equations.append(f"for j in 1:3 loop cells[j].u = j + {u.text}; end for;")
    for c in (1, 2, 3):
        for i in (1, 2):

            def value(v: dict[str, Any], c: int = c, i: int = i) -> float:
                own = {"k": k.value({**v, "j": c + first - 1}), "u": c + u.value(v), "time": v["time"]}
                return body.value({**own, "i": i})

            w.meaning.steps.append((f"cells[{c}].x[{i}]", value))
    w.observed += [f"cells[{c}].x[{i}]" for c in (1, 2, 3) for i in (1, 2)]
    # Some of these are refused: the compiler applies the subscripts to the array of components.
    forms = [("cells[2].x[1] - cells[3].x[2]", lambda v: v["cells[2].x[1]"] - v["cells[3].x[2]"])] * 3
    forms += [
        ("sum(cells[2].x)", lambda v: v["cells[2].x[1]"] + v["cells[2].x[2]"]),
        ("sum(cells.x[1])", lambda v: sum(v[f"cells[{c}].x[1]"] for c in (1, 2, 3))),
        ("sum(cells.u)", lambda v: sum(c + u.value(v) for c in (1, 2, 3))),
    ]
    text, meaning = w.random.choice(forms)
    w.add("of_cells", Term(text, meaning))


def redeclared(w: Writer) -> None:
    """Add a component and a function, either of which may be redeclared in a modifier or extends clause."""
    functions = [random_function(f"way{i}", w.random, (), kinds=("scalar",)) for i in (1, 2)]
    bodies = [Terms(w.random, Scope(reals=("k", "time"))).real(2) for _ in range(2)]
    w.package.append(
        "  partial function way\n    input Real u1;\n    output Real y;\n  end way;\n"
        + "\n".join(
            # They extend the interface, because a replacement must be of the same type.
            text.replace("    input Real u1;\n    output Real y;", "    extends way;")
            for text, _ in functions
        )
        + "\n  partial model Source\n    parameter Real k = 1;\n    Real z;\n  end Source;\n"
        + "\n".join(
            f"  model Source{i}\n    extends Source;\n  equation\n    z = {body.text};\n  end Source{i};"
            for i, body in enumerate(bodies, 1)
        )
        + "\n  model Taken\n    replaceable function f = way1 constrainedby way;\n"
        "    replaceable Source1 source(k = 0.5) constrainedby Source;\n    Real y;\n  equation\n"
        "    y = f(source.z) + source.z;\n  end Taken;"
    )
    k = w.terms(CONSTANT).real(1)
    function, component = w.random.random() < 0.5, w.random.random() < 0.5
    changes = [*(["redeclare function f = way2"] if function else [])]
    if component:
        changes.append(f"redeclare Source2 source(k = {k.text})")
    if changes and w.random.random() < 0.5 and not component:
        w.package.append(f"  model Other\n    extends Taken({', '.join(changes)});\n  end Other;")
        w.declarations.append("Other taken;")
    else:
        w.declarations.append(f"Taken taken{'(' + ', '.join(changes) + ')' if changes else ''};")
    call = functions[function][1].call

    def value(v: dict[str, Any]) -> float:
        own = {"k": k.value(v) if component else 0.5, "time": v["time"]}
        z = bodies[component].value(own)
        return call(z) + z

    w.meaning.steps.append(("taken.y", value))
    w.observed.append("taken.y")
    w.scope = w.scope.more(reals=("taken.y",))
