"""The part of a build that the tests of each folder need."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path

import pytest

from tests.shared_fmus import plain_builds

#: Here FMUs are built for the motion of their models alone.
PLAIN = ("codegen", "models")


@pytest.fixture(scope="module", autouse=True)
def _builds(request: pytest.FixtureRequest) -> Iterator[None]:
    folder = request.path.relative_to(Path(__file__).parent).parts[0]
    with plain_builds() if folder in PLAIN else nullcontext():
        yield
