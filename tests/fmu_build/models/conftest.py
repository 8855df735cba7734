"""The FMUs of the models that the selected tests need."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import pytest

from .case import Case
from .runner import Workshop


@pytest.fixture(scope="session")
def workshop(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    """Begins to build every model of the session's cases."""
    parameters = [item.callspec.params for item in request.session.items if hasattr(item, "callspec")]
    cases = [found["case"] for found in parameters if isinstance(found.get("case"), Case)]
    models = {case.model: case.library for case in cases}
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        yield Workshop(tmp_path_factory.mktemp("fmus"), models, pool)
        pool.shutdown(cancel_futures=True)
