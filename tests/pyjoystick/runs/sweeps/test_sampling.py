"""The runs of a design."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from pyjoystick.runs import Sampling, design
from pyjoystick.runs.sweeps.sampling import METHODS, Method, digest
from pyjoystick.runs.sweeps.variations import Levels, Normal, Uniform, Variation
from pyjoystick.support import ParameterError

PAIR: dict[str, Variation] = {"a": Uniform(0.0, 1.0), "b": Normal(0.0, 1.0)}
SAMPLED: list[Method] = ["random", "latin-hypercube", "sobol", "saltelli"]


def test_a_grid_is_every_combination_with_the_last_parameter_fastest() -> None:
    table = design({"a": Levels((1.0, 2.0)), "b": Levels((3, 4, 5)), "c": Levels((True,))}, Sampling("grid"))
    assert table["a"].tolist() == [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]
    assert table["b"].tolist() == [3, 4, 5, 3, 4, 5]
    assert table["c"].dtype == np.bool_
    assert table.index.name == "run"


@pytest.mark.parametrize("method", SAMPLED)
def test_the_seed_decides_the_runs(method: Method) -> None:
    first, again, other = (design(PAIR, Sampling(method, 16, seed)) for seed in (1, 1, 2))
    assert first.equals(again)
    assert not np.any(first == other)
    assert digest(first) == digest(again) != digest(other)


@pytest.mark.parametrize("method", ["random", "latin-hypercube", "sobol"])
def test_samples_have_their_distributions(method: Method) -> None:
    table = design(PAIR, Sampling(method, 4096, 3))
    assert stats.kstest(table["a"], stats.uniform.cdf).pvalue > 1e-3
    assert stats.kstest(table["b"], stats.norm.cdf).pvalue > 1e-3
    assert abs(stats.pearsonr(table["a"], table["b"]).statistic) < 0.06  # four standard errors


def test_a_latin_hypercube_has_one_sample_in_each_interval() -> None:
    table = design({"a": Uniform(0.0, 1.0), "c": Uniform(5.0, 7.0)}, Sampling("latin-hypercube", 50, 1))
    assert sorted(np.floor(table["a"] * 50)) == list(range(50))
    assert sorted(np.floor((table["c"] - 5.0) * 25)) == list(range(50))


def test_a_saltelli_design_exchanges_one_column_at_a_time() -> None:
    varied = PAIR | {"c": Uniform(2.0, 3.0)}
    table = design(varied, Sampling("saltelli", 8, 5)).to_numpy()
    a, b, *mixed = np.split(table, 5)
    assert not np.any(a == b)
    for i, one in enumerate(mixed):
        np.testing.assert_array_equal(one[:, i], b[:, i])
        np.testing.assert_array_equal(np.delete(one, i, axis=1), np.delete(a, i, axis=1))


def test_the_digest_tells_names_and_types_apart() -> None:
    one = design({"a": Levels((1, 2))}, Sampling("grid"))
    assert digest(one) != digest(one.rename(columns={"a": "b"}))
    assert digest(one) != digest(one.astype(float))


@pytest.mark.parametrize(
    ("sampling", "varied", "message"),
    [
        (Sampling("grid"), PAIR, "a = a distribution: must be levels"),
        (Sampling("random", 0), PAIR, "count = 0: must be 1 or more"),
        (
            Sampling("sobol", 1000),
            PAIR,
            "count = 1000: must be a power of two for method sobol .such as 1024",
        ),
        (Sampling("saltelli", 3), PAIR, "count = 3: must be a power of two"),
        (Sampling("saltelli", 8), {"a": PAIR["a"]}, "must be used with 2 parameters"),
        (Sampling("random", 10**9), PAIR, "runs = 1000000000: must be 10000000 at most"),
    ],
)
def test_designs_that_make_no_sense(sampling: Sampling, varied: dict[str, Variation], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        design(varied, sampling)


def test_every_method_tells_its_number_of_runs() -> None:
    for method in METHODS:
        varied: dict[str, Variation] = {"a": Levels((1.0, 2.0)), "b": Levels((1.0, 2.0, 3.0))}
        sampling = Sampling(method, 4)
        assert sampling.runs(varied) == len(design(varied, sampling))
