"""Fixtures of the tests of extensions."""

from pathlib import Path

import pytest

from pipeline.records import sources


@pytest.fixture(scope="session")
def derived(pickled):
    """The dataset of all derivations, which takes seconds to compute."""
    from extensions.proofs.derivations import derivations
    from helpers.parts.claim_data import made

    return pickled("derivations", lambda: made(derivations), "extensions.proofs.derivations")


@pytest.fixture(scope="session")
def flowing(pickled):
    """The dataset of the flux, whose areas take seconds to compute."""
    from helpers.parts import claim_data

    module = "extensions.claims.analyses.flux"
    return pickled("flux", claim_data.flux_of_the_paper, module)


@pytest.fixture(scope="session")
def datasets(pickled, derived, flowing):
    """All datasets that the checks of claims need, computed with little work."""
    from helpers.parts import claim_data

    file = Path(claim_data.__file__)  # what it imports computes them
    modules = sources._imported_modules(sources.SRC, file, "")
    return pickled("claims", lambda: claim_data.datasets(derived, flowing), *modules)


@pytest.fixture(scope="session")
def packed(shared, accepted):
    """The archive of `accepted`."""
    from extensions.publication import archive
    from pipeline import config

    def pack(folder):
        archive.write(accepted.path, config.load(accepted.config), folder / "a.tar")

    return shared("archive", pack) / "a.tar"
