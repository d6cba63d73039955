"""Fixtures of the tests of claims."""

import pytest
from claim_data import datasets as computed


@pytest.fixture(scope="session")
def datasets(pickled, derived):
    """All datasets that the checks of claims need."""
    return pickled("claims", lambda: computed(derived))
