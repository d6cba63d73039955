"""Stages that measure times or need external solvers. Their data differ between machines."""

import xarray as xr

from . import failures
from . import work as work_precision
from .methods import Method
from .methods.counted_methods import METHODS, OURS
from .stages import described
from .timing import machine

# Names of the external solvers that are compared near grazing.
_GRAZING_SOLVERS = (
    "brentq 0.1, 1e-12",
    "RK45, 1e-06",
    "DOP853, 1e-09",
    "DOP853, steps <= 0.1, 1e-12",
    "LSODA, 1e-09",
    "heyoka any, 1e-15",
    "heyoka positive, 1e-15",
)


def work_all() -> xr.Dataset:
    """Compare error and seconds of all methods, with external solvers."""
    return _measured("work_all", work_precision.measured([*METHODS, *_external_solvers()]))


def edges_all() -> xr.Dataset:
    """Compare external solvers near grazing and near a touch of the floor."""
    return _measured("edges_all", failures.edges(_grazing_methods(), 40))


def missed_all() -> xr.Dataset:
    """Count the impacts that external solvers miss."""
    return _measured("missed_all", failures.missed(_grazing_methods()))


def _external_solvers() -> list[Method]:
    """Return the external solvers; their packages are installed for the study alone."""
    from .methods import scipy_events, taylor

    return [*scipy_events.METHODS, *taylor.METHODS]


def _grazing_methods() -> list[Method]:
    """Return the certified march and the external solvers that are compared near grazing."""
    return [OURS, *(m for m in _external_solvers() if m.name in _GRAZING_SOLVERS)]


def _measured(comparison: str, dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset of measurements with the description of the machine."""
    return described(comparison, dataset).assign_attrs(machine())
