"""The parts of the study, as stages, that measure times or need external solvers."""

from typing import Any

import xarray as xr

from . import failures
from . import work as work_precision
from .machine import machine
from .methods.counted_methods import METHODS, OURS
from .stages import described

# The settings of external solvers that are compared near grazing.
_GRAZING_SOLVERS = (
    "certified march",
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
    return _measured("work_all", work_precision.measured([*METHODS, *_library_solvers()]))


def edges_all() -> xr.Dataset:
    """Compare external solvers near grazing and near a touch of the floor."""
    return _measured("edges_all", failures.edges(_grazing_solvers(), 40))


def missed_all() -> xr.Dataset:
    """Count the impacts that external solvers miss."""
    return _measured("missed_all", failures.missed(_grazing_solvers()))


def _library_solvers() -> list[Any]:
    """Return the solvers whose packages are installed for the study alone."""
    from .methods import scipy_events, taylor

    return [*scipy_events.METHODS, *taylor.METHODS]


def _grazing_solvers() -> list[Any]:
    return [m for m in (OURS, *_library_solvers()) if m.name in _GRAZING_SOLVERS]


def _measured(part: str, dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset of measurements, which describes the machine."""
    return described(part, dataset).assign_attrs(machine())
