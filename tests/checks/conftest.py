"""Fixtures of the tests of claims and archives."""

import pytest
from claim_data import datasets as computed

from pipeline import config
from pipeline.checks import archive


@pytest.fixture(scope="session")
def datasets(pickled, derived):
    """All datasets that the checks of claims need."""
    return pickled("claims", lambda: computed(derived))


@pytest.fixture(scope="session")
def packed(accepted, tmp_path_factory):
    """The archive of `accepted`."""
    path = tmp_path_factory.mktemp("archive") / "a.tar"
    archive.write(accepted.path, config.load(accepted.config), path)
    return path
