"""What the tests of claims share."""

import pickle

import pytest
from claim_data import datasets as computed


def _compute(folder):
    folder.mkdir()
    (folder / "datasets").write_bytes(pickle.dumps(computed()))


@pytest.fixture(scope="session")
def datasets(shared):
    """All datasets that the checks of claims need, computed once for all workers."""
    return pickle.loads((shared("claims", _compute) / "datasets").read_bytes())
