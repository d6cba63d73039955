"""Save and load datasets as uncompressed netCDF-4 files with CF attributes.

The same dataset always gives the same bytes: variables and attributes are written in a fixed order
and without a date, and nothing is compressed, because compressed bytes depend on the system's
zlib. Ragged arrays are contiguous: `row_size` counts the samples of each row.
"""

import json
import math
import os
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import numpy.typing as npt
import xarray as xr

from .files import replacing, why_not_a_file


class ArtifactError(ValueError):
    """A dataset that cannot be saved, or a file that `save` did not write; the message names it."""


# Global attributes of every file, beside its title.
ABOUT = {
    "Conventions": "CF-1.11",
    "references": (
        "E. Kanso and P. Papadopoulos, Dynamics of pseudo-rigid ball impact on rigid foundation"
    ),
    "source": "pseudorigid, from the parameters in the attribute config",
}


def save(
    dataset: xr.Dataset, path: str | os.PathLike[str], config: dict[str, Any], **attributes: Any
) -> None:
    """Save a dataset as netCDF-4, whole or not at all; raises ArtifactError or FileError.

    Every variable needs `long_name` and, unless it holds text, units "1" and a scale. NaN is stored
    as it is: no variable has a fill value. The global attributes are the dataset's own, ABOUT,
    `attributes`, and `config` (the block of configuration behind the data) as canonical JSON.
    """
    attributes |= {"config": canonical_json(config)} | ABOUT
    dataset = dataset.assign_attrs(attributes)
    _check(dataset, path, with_scales=True)
    with replacing(path) as part:
        _write(dataset, part)


def load(path: str | os.PathLike[str]) -> xr.Dataset:
    """Load a dataset into memory; raises ArtifactError if `save` did not write the file."""
    path = Path(path)
    if not path.is_file():
        raise ArtifactError(f"{path}: {why_not_a_file(path) or 'no such artifact'}")
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            file.set_auto_scale(False)
            # Nothing is compressed: a file that declares more values than it has bytes is damaged.
            if sum(math.prod(v.shape) for v in file.variables.values()) > path.stat().st_size:
                raise ArtifactError(f"{path}: damaged: it has fewer values than it declares")
            variables = {
                name: (variable.dimensions, variable[...], _attributes(variable))
                for name, variable in file.variables.items()
            }
            attrs = _attributes(file)
    except ArtifactError:
        raise
    except Exception as error:  # netCDF4 raises many types for damaged files
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        raise ArtifactError(f"{path}: damaged, or not netCDF ({reason})") from error
    if "config" not in attrs:
        raise ArtifactError(f"{path}: not an artifact: no attribute config")
    try:
        dataset = xr.Dataset(variables, attrs=attrs)
    except ValueError as error:
        raise ArtifactError(f"{path}: not an artifact: {error}") from error
    _check(dataset, path, with_scales=False)  # files of older versions have none
    return dataset


def canonical_values(variable: xr.Variable) -> tuple[str, npt.NDArray[Any] | list[str]]:
    """Return the dtype ("str" for text) and the flattened values, equal on every machine.

    Numbers are little-endian, and all NaN have the same bits.
    """
    if _is_text(variable):
        return "str", [str(value) for value in variable.values.ravel()]
    dtype = variable.dtype.newbyteorder("<").str
    values = np.ascontiguousarray(variable.values, dtype=dtype).ravel()
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), np.array(np.nan, dtype=dtype), values)
    return dtype, values


def plain_attributes(source: xr.Dataset | xr.Variable) -> dict[str, Any]:
    """Return attributes by name as plain numbers and text; netCDF has no lists of one number."""
    arrays = {str(name): np.asarray(value) for name, value in sorted(source.attrs.items())}
    return {
        name: array.item() if array.size == 1 else array.tolist() for name, array in arrays.items()
    }


def canonical_json(value: Any) -> str:
    """Return JSON with sorted keys and without spaces: equal values give equal texts."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _check(dataset: xr.Dataset, path: str | os.PathLike[str], with_scales: bool) -> None:
    """Raise ArtifactError for a variable of a wrong dtype, or without a name, units or a scale."""
    for name, variable in dataset.variables.items():
        text, units = _is_text(variable), variable.attrs.get("units")
        if not text and variable.dtype.kind not in "iuf":
            raise ArtifactError(f"{path}: variable {name} has dtype {variable.dtype}")
        if not variable.attrs.get("long_name"):
            raise ArtifactError(f"{path}: variable {name} has no long_name")
        if not text and units != "1":
            raise ArtifactError(f'{path}: variable {name} has units {units!r}, not "1"')
        if with_scales and not text and not variable.attrs.get("scale"):
            raise ArtifactError(f"{path}: variable {name} has no scale")


def _write(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset to a new file, in a fixed order."""
    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts({name: dataset.attrs[name] for name in sorted(dataset.attrs)})
        for dim in sorted(map(str, dataset.sizes)):
            file.createDimension(dim, dataset.sizes[dim])
        for name in sorted(map(str, dataset.variables)):
            variable = dataset.variables[name]
            text = _is_text(variable)
            dtype: Any = str if text else variable.dtype.newbyteorder("=")
            dims = tuple(map(str, variable.dims))
            target = file.createVariable(name, dtype, dims, fill_value=False)
            target.set_auto_mask(False)
            target.setncatts({key: variable.attrs[key] for key in sorted(variable.attrs)})
            target[...] = np.asarray(variable.values, dtype=object if text else dtype)


def _attributes(source: Any) -> dict[str, Any]:
    return {name: source.getncattr(name) for name in source.ncattrs()}


def _is_text(variable: xr.Variable) -> bool:
    return variable.dtype.kind in "UOT"
