"""The one door through which data is saved and read: uncompressed netCDF-4 with CF attributes.

The same dataset always gives the same bytes: variables and attributes go in a fixed order, nothing
is compressed (compressed bytes depend on the system's zlib), and no date is written. Ragged
arrays are contiguous: `row_size` counts the samples of each row, one row after the other.
"""

import hashlib
import json
import math
from pathlib import Path

import netCDF4
import numpy as np
import xarray as xr

from .files import obstacle, replacing


class ArtifactError(ValueError):
    """A dataset that cannot be saved, or a file that is no artifact; the message names it."""


# Global attributes of every file, beside its title.
ABOUT = {
    "Conventions": "CF-1.11",
    "references": (
        "E. Kanso and P. Papadopoulos, Dynamics of pseudo-rigid ball impact on rigid foundation"
    ),
    "source": "pseudorigid, from the parameters in the attribute config",
}


def title_of(function):
    """The title of the datasets that a function returns: its name, in words.

    Docstrings do not count as sources of a result, and so decide no byte of it.

    Parameters
    ----------
    function : callable

    Returns
    -------
    str
    """
    return function.__name__.removeprefix("scene_").replace("_", " ").capitalize()


def save(dataset, path, config, **attributes):
    """Save a dataset as netCDF-4, whole or not at all.

    NaN is stored as it is: no variable has a fill value.

    Parameters
    ----------
    dataset : xarray.Dataset
        Every variable needs `long_name` and, strings apart, units "1" and a scale.
    path : path
    config : dict
        The block of configuration behind the data, stored as canonical JSON.
    **attributes : str or number
        Global ones beside the dataset's own and those of ABOUT.

    Raises
    ------
    ArtifactError
        A dataset that is not of that form.
    FileError
        A file that cannot be written.
    """
    attributes |= {"config": canonical_json(config)} | ABOUT
    dataset = _with_sample_dimension(dataset.assign_attrs(attributes), path)
    _check(dataset, path)
    for name, variable in dataset.variables.items():  # files made before scales can still be read
        if not _is_text(variable) and not variable.attrs.get("scale"):
            raise ArtifactError(f"{path}: variable {name} has no scale")
    with replacing(path) as part:
        _write(dataset, part)


def load(path):
    """An artifact in memory, its file closed.

    Parameters
    ----------
    path : path

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    ArtifactError
        One line that names the file, if it is missing, damaged or not written by `save`.
    """
    path = Path(path)
    if not path.is_file():
        raise ArtifactError(f"{path}: {obstacle(path) or 'no such artifact'}")
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            file.set_auto_scale(False)
            # Values are stored as they are: what says that it has more than the file is damaged.
            if sum(math.prod(v.shape) for v in file.variables.values()) > path.stat().st_size:
                raise ArtifactError(f"{path}: damaged: it has fewer values than it says")
            variables = {
                name: (variable.dimensions, variable[...], _attributes(variable))
                for name, variable in file.variables.items()
            }
            attrs = _attributes(file)
    except ArtifactError:
        raise
    except Exception as error:  # of a damaged file, whatever netCDF4 makes of it
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        raise ArtifactError(f"{path}: damaged, or not netCDF ({reason})") from error
    if "config" not in attrs:
        raise ArtifactError(f"{path}: not an artifact: no attribute config")
    try:
        dataset = xr.Dataset(variables, attrs=attrs)
    except ValueError as error:
        raise ArtifactError(f"{path}: not an artifact: {error}") from error
    _check(dataset, path)
    return dataset


def content_hash(dataset):
    """Hash of names, dims, dtypes, values and attributes.

    It says nothing about the container: not the library versions that netCDF embeds, not the
    order of variables, not byte order. All NaN count as one value; 0.0 and -0.0 differ.

    Parameters
    ----------
    dataset : xarray.Dataset

    Returns
    -------
    str
        sha256 in hex.
    """
    digest = hashlib.sha256()
    _feed(digest, sorted(dataset.sizes.items()), plain_attributes(dataset))
    for name in sorted(dataset.variables):
        variable = dataset.variables[name]
        kind, values = canonical_values(variable)
        _feed(digest, name, variable.dims, variable.shape, kind, plain_attributes(variable))
        if kind == "str":
            _feed(digest, values)
        else:
            digest.update(values.tobytes())
    return digest.hexdigest()


def canonical_values(variable):
    """The values of a variable in one row, the same on every machine.

    Parameters
    ----------
    variable : xarray.Variable

    Returns
    -------
    kind : str
        The dtype, or "str".
    values : ndarray or list of str
        Little-endian numbers, with one NaN.
    """
    if _is_text(variable):
        return "str", [str(value) for value in variable.values.ravel()]
    kind = variable.dtype.newbyteorder("<").str
    values = np.ascontiguousarray(variable.values, dtype=kind).ravel()
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), np.array(np.nan, dtype=kind), values)
    return kind, values


def plain_attributes(source):
    """Attributes as plain numbers and text: netCDF keeps one number and a list of one alike.

    Parameters
    ----------
    source : xarray.Dataset or xarray.Variable

    Returns
    -------
    dict
        In the order of names.
    """
    arrays = {name: np.asarray(value) for name, value in sorted(source.attrs.items())}
    return {
        name: array.item() if array.size == 1 else array.tolist() for name, array in arrays.items()
    }


def canonical_json(value):
    """A value as JSON with sorted keys and no spaces: equal values, equal text.

    Parameters
    ----------
    value : dict, list, str, number, bool or None

    Returns
    -------
    str
    """
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _with_sample_dimension(dataset, path):
    """Name in `row_size` the dimension that it counts, as CF's ragged arrays require."""
    if "row_size" not in dataset:
        return dataset
    counts = dataset["row_size"]
    dims = [dim for dim in dataset.sizes if dim not in counts.dims]
    sample = counts.attrs.get("sample_dimension", dims[0] if len(dims) == 1 else None)
    if sample not in dataset.sizes:
        raise ArtifactError(f"{path}: row_size does not say which dimension it counts")
    if int(counts.sum()) != dataset.sizes[sample]:
        raise ArtifactError(
            f"{path}: row_size adds up to {int(counts.sum())}, "
            f"but dimension {sample} has {dataset.sizes[sample]}"
        )
    attrs = counts.attrs | {"sample_dimension": sample}
    return dataset.assign(row_size=(counts.dims, counts.values, attrs))


def _check(dataset, path):
    for name, variable in dataset.variables.items():
        text, units = _is_text(variable), variable.attrs.get("units")
        if not text and variable.dtype.kind not in "iuf":
            raise ArtifactError(f"{path}: variable {name} has dtype {variable.dtype}")
        if not variable.attrs.get("long_name"):
            raise ArtifactError(f"{path}: variable {name} has no long_name")
        if not text and units != "1":
            raise ArtifactError(f'{path}: variable {name} has units {units!r}, not "1"')


def _write(dataset, path):
    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts({name: dataset.attrs[name] for name in sorted(dataset.attrs)})
        for dim in sorted(dataset.sizes):
            file.createDimension(dim, dataset.sizes[dim])
        for name in sorted(dataset.variables):
            variable = dataset.variables[name]
            text = _is_text(variable)
            kind = str if text else variable.dtype.newbyteorder("=")
            target = file.createVariable(name, kind, variable.dims, fill_value=False)
            target.set_auto_mask(False)
            target.setncatts({key: variable.attrs[key] for key in sorted(variable.attrs)})
            target[...] = np.asarray(variable.values, dtype=object if text else kind)


def _attributes(source):
    return {name: source.getncattr(name) for name in source.ncattrs()}


def _is_text(variable):
    return variable.dtype.kind in "UOT"


def _feed(digest, *items):
    digest.update((json.dumps(items) + "\n").encode())
