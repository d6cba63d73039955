"""Fixtures of the tests of archives."""

import pytest

from pipeline import config
from pipeline.publication import archive


@pytest.fixture(scope="session")
def packed(accepted, tmp_path_factory):
    """The archive of `accepted`."""
    path = tmp_path_factory.mktemp("archive") / "a.tar"
    archive.write(accepted.path, config.load(accepted.config), path)
    return path
