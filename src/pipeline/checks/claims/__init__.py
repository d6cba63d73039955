"""Every checkable statement of the paper (claims.toml), with a check that gives a verdict on it."""

from collections.abc import Mapping
from inspect import getmembers, isfunction
from pathlib import Path

import xarray as xr

from . import chaos, model, periodic, schema

# MODULE.FUNCTION -> each public function of the modules with checks.
CHECKS = {
    f"{module.__name__.rpartition('.')[2]}.{name}": function
    for module in (model, periodic, chaos)
    for name, function in getmembers(module, isfunction)
    if function.__module__ == module.__name__ and not name.startswith("_")
}
TEXT = Path(__file__).with_name("claims.toml").read_text(encoding="utf-8")
DOCUMENT = schema.load(TEXT, CHECKS)
CLAIMS, VERDICTS = DOCUMENT.claims, DOCUMENT.verdicts


def required_datasets() -> list[str]:
    """Return the names of all datasets that the checks need, sorted."""
    return sorted({name for claim in CLAIMS.values() for name in claim.data})


def required_theorems() -> list[str]:
    """Return the names of all theorems that the checks ask for, sorted."""
    return sorted({name for claim in CLAIMS.values() for name in claim.theorems})


def judge_claims(
    datasets: Mapping[str, xr.Dataset], proofs: Mapping[str, str]
) -> list[schema.Verdict]:
    """Return the verdicts on all claims, by number.

    `datasets` are all of `required_datasets()`; a theorem that `proofs` does not name counts as not
    proved.
    """
    return [claim.judge(datasets, proofs) for claim in CLAIMS.values()]
