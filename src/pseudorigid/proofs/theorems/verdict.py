"""The verdict on a theorem as a dataset, for workflows that keep it."""

import xarray as xr

from .statements import THEOREMS


def theorem_verdict(name: str) -> xr.Dataset:
    """Check a theorem from its certificate.

    The dataset has no variable. Its attributes are verdict, "proved" or "not proved", reason, which
    is empty if it is proved, and statement.
    """
    result = THEOREMS[name].check()
    attributes = {"verdict": result.verdict, "reason": result.reason}
    return xr.Dataset(attrs=attributes | {"statement": result.statement})
