"""Unsupported and invalid models are refused with a typed error that names the position."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_build import ModelicaError, ModelNotFoundError, UnsupportedModelError, build_fmu
from fmu_build.support.errors import BuildError

REFUSED = Path(__file__).parent / "refused"


@dataclass(frozen=True)
class Refusal:
    """A model, the error it must raise, and what the message must name.

    Where the source has a line marked ``// here``, the message must name that line too.
    """

    model: str
    error: type[BuildError]
    names: str

    @property
    def file(self) -> Path:
        return REFUSED / f"{self.model.partition('.')[0]}.mo"

    @property
    def line(self) -> int | None:
        lines = self.file.read_text("utf-8").splitlines()
        return next((k for k, line in enumerate(lines, 1) if "// here" in line), None)


REFUSALS = (
    Refusal("AssignedTwice", UnsupportedModelError, r"assigned again"),
    Refusal("AtTheEnd", UnsupportedModelError, r"terminal\(\)"),
    Refusal("BooleanIndex", UnsupportedModelError, r"size of x, Boolean"),
    Refusal("BooleanLoop", ModelicaError, r"`a`"),
    Refusal(
        "ChangedConstants.Columns",
        UnsupportedModelError,
        r"the equation Water\.weight \* time differs in the compiler's reading",
    ),
    Refusal(
        "ChangedFunction.Pair", UnsupportedModelError, r"functions of Law, which has several meanings in it"
    ),
    Refusal("CartesianPendulum", UnsupportedModelError, r"constraints between its states"),
    Refusal(
        "ConstrainedReinit", UnsupportedModelError, r"reinit\(\) is not supported for a variable that follows"
    ),
    Refusal("ContradictoryStart", UnsupportedModelError, r"more initial equations"),
    Refusal("Delayed", UnsupportedModelError, r"delay\(\)"),
    Refusal("DerivativeOfProduct", UnsupportedModelError, r"der\(x\*x\)"),
    Refusal("DiscreteArray", UnsupportedModelError, r"array above"),
    Refusal("DiscreteLoop", UnsupportedModelError, r"array level"),
    Refusal("DottedModifier", UnsupportedModelError, r"other\.rate is lost; write other\(rate \.\.\.\)"),
    Refusal("EnumerationInitial", UnsupportedModelError, r"type Enumeration"),
    Refusal("EarlyReturn", UnsupportedModelError, r"return"),
    Refusal("ExternalFunction", UnsupportedModelError, r"external.*outside"),
    Refusal("FoldInBranch", UnsupportedModelError, r"a loop, a sum\(\) or the like with if-statements"),
    Refusal("Incomplete", ModelNotFoundError, r"partial"),
    Refusal("InitialDiscrete", UnsupportedModelError, r"initial equation with a discrete variable"),
    Refusal("InputChange", ModelicaError, r"change\("),
    Refusal(
        "InputLimit", UnsupportedModelError, r"pre\(y\) is not supported, because it follows the input u"
    ),
    Refusal("InputDerivative", UnsupportedModelError, r"der\(u\)"),
    Refusal("LeftOut", UnsupportedModelError, r"first result"),
    Refusal("LocalRecord", UnsupportedModelError, r"the record r in function"),
    Refusal("LoopWithDefault", UnsupportedModelError, r"reading t before a loop that assigns it"),
    Refusal("LostConstraint", UnsupportedModelError, r"1 instead of 4: .* part\.k"),
    Refusal("LateStart", UnsupportedModelError, r"start value of v depends on p, which initial equations"),
    Refusal("LeakingModifier", UnsupportedModelError, r"7 instead of 3: .* outer1\.inside\.gain\.k"),
    Refusal("LeakingStart", UnsupportedModelError, r"the start value is 400 instead of 300: .* body\.rod\.T"),
    Refusal("ArraysInExtends", UnsupportedModelError, r"3 instead of 7: .* d\.p"),
    Refusal(
        "LostInShortClass", UnsupportedModelError, r"the nominal value 5 is lost: .* train\.body\[1\]\.v"
    ),
    Refusal("LostModifiers", UnsupportedModelError, r"1 instead of 4: .* whole\.part\.k"),
    Refusal("LostSiblings", UnsupportedModelError, r"0 instead of 6: .* assembly\.spring\.x"),
    Refusal("MemberSlice", UnsupportedModelError, r"a subscript of a member of an array"),
    Refusal("NoEventAndSample", UnsupportedModelError, r"with noEvent\(\) or without it, not both"),
    Refusal("OperatorRecord", UnsupportedModelError, r"operator records"),
    Refusal("OtherState", UnsupportedModelError, r"reinit\(\) of v_1 would keep v_2.* not v_rel"),
    Refusal("OwnBase.Model", UnsupportedModelError, r"extends a class of its own"),
    Refusal("ParameterFromTime", UnsupportedModelError, r"`origin` is determined from `time`"),
    Refusal("PresentState", UnsupportedModelError, r"pre\(state\)"),
    Refusal("ReorderedArguments.Model", UnsupportedModelError, r"the argument b would be taken for another"),
    Refusal(
        "ArraysNamedLikeInherited",
        UnsupportedModelError,
        r"1 instead of 3: .* arm\.m",
    ),
    Refusal("RecordArray", UnsupportedModelError, r"der\(r\[i\]\.a\)"),
    Refusal("SampledElsewhen", UnsupportedModelError, r"sample\("),
    Refusal("SecondDerivative", UnsupportedModelError, r"der\(der\(x\)\)"),
    Refusal("SequentialAlgorithm", UnsupportedModelError, r"`y`"),
    Refusal("SlicedRecords", UnsupportedModelError, r"a subscript of a member of an array"),
    Refusal("StartFromInput", UnsupportedModelError, r"start"),
    Refusal("StringVariable", UnsupportedModelError, r"String"),
    Refusal("SwitchedConstraint", UnsupportedModelError, r"constraints between its states"),
    Refusal("SyntaxError", ModelicaError, r"unexpected `;`"),
    Refusal("TooFewEquations", ModelicaError, r"2 equations, 3 unknowns"),
    Refusal("TooManyEquations", ModelicaError, r"2 equations, 1 unknowns"),
    Refusal("Transport", UnsupportedModelError, r"spatialDistribution"),
    Refusal("UnbalancedConnector", ModelicaError, r"'Port'"),
    Refusal("UnknownClass", ModelicaError, r"'NoSuchClass'"),
    Refusal("UnknownParameter", UnsupportedModelError, r"\bk\b"),
    Refusal("UnknownVariable", ModelicaError, r"'missing_variable'"),
    Refusal("WrongType", ModelicaError, r"Boolean"),
)


@pytest.mark.parametrize("refusal", REFUSALS, ids=lambda refusal: refusal.model)
def test_refusal(refusal: Refusal, tmp_path: Path) -> None:
    earlier = tmp_path / f"{refusal.model.rpartition('.')[2]}.fmu"
    earlier.write_bytes(b"from an earlier build")
    with pytest.raises(refusal.error) as caught:
        build_fmu(refusal.model, tmp_path, library=refusal.file)
    message = str(caught.value)
    assert type(caught.value) is refusal.error
    assert re.search(refusal.names, message), message
    assert refusal.file.name in message, message
    if refusal.line is not None:
        assert f"{refusal.file.name}:{refusal.line}" in message, message
    assert list(tmp_path.iterdir()) == [earlier]
    assert earlier.read_bytes() == b"from an earlier build"


def test_what_a_model_does_not_use_does_not_matter(tmp_path: Path) -> None:
    """The file has a class that would be refused; the model beside it is built."""
    result = build_fmu("LostModifiers.Part", tmp_path, library=REFUSED / "LostModifiers.mo")
    assert result.path.is_file()


def test_what_stands_in_a_file_beside_the_model_does_not_matter(tmp_path: Path) -> None:
    """The compiler reads all files of the folder; another package there has a class of the same name."""
    (tmp_path / "Mine.mo").write_text(
        "model Mine Part part; end Mine;\nmodel Part Real x = time; end Part;\n"
    )
    (tmp_path / "Other.mo").write_text(
        (REFUSED / "LostModifiers.mo").read_text("utf-8").replace("LostModifiers", "Other")
    )
    assert build_fmu("Mine", tmp_path, library=tmp_path / "Mine.mo").path.is_file()


def test_every_refused_model_is_tried() -> None:
    assert {path.stem for path in REFUSED.glob("*.mo")} == {refusal.file.stem for refusal in REFUSALS}


@pytest.mark.parametrize(
    ("model", "library"),
    [
        ("Oscillators.NoSuchModel", "Oscillators.mo"),
        ("NoSuchPackage.Model", "Oscillators.mo"),
        ("Oscillators.Harmonic", "no_such_file.mo"),
        ("Oscillators", "Oscillators.mo"),
        ("Functions.square", "Functions.mo"),
        ("Components.Flange", "Components.mo"),
    ],
)
def test_not_a_model(model: str, library: str, tmp_path: Path) -> None:
    output = tmp_path / "output"
    with pytest.raises(
        ModelNotFoundError, match=re.escape(model if library != "no_such_file.mo" else library)
    ):
        build_fmu(model, output, library=REFUSED.parent / library)
    assert not output.exists()
