"""The files of a sweep: blocks of cells, and the dataset that they are joined into.

A block carries the hash of its own content, so that a damaged one is known wherever it comes from.
The dataset is written block by block, in memory that does not grow with the grid, and its sha256
is kept beside it. The same cells give the same bytes, whatever blocks they came in.
"""

import shutil
from contextlib import contextmanager
from itertools import groupby

import netCDF4
import numpy as np
import xarray as xr

from pseudorigid.sweep.cell import PERIODS, VARIABLES, cells

from . import artifacts
from .files import replacing
from .provenance import file_hash

AXES = {"k": "Euler inertia", "energy": "energy over g^2"}
PERIOD = ("period", np.arange(1, PERIODS + 1), "islands of a chain")


class StoreError(ValueError):
    """One line about a file of a sweep that is damaged, of another sweep, or cannot be written."""


def compute(block) -> xr.Dataset:
    """The cells of a block, as from grid.block, on the dim `cell`."""
    found = []
    for k, row in groupby(block["cells"], key=lambda pair: pair[0]):
        found += cells(k, [e for _, e in row], block["starts"], block["impacts"])
    dataset = xr.Dataset(
        {
            name: (_dims(name, "cell"), np.array([c[name] for c in found], kind), _about(text))
            for name, (text, kind) in VARIABLES.items()
        }
    )
    for i, (name, text) in enumerate(AXES.items()):
        dataset[name] = ("cell", np.array([c[i] for c in block["cells"]], float), _about(text))
    return dataset.assign(period=(PERIOD[0], PERIOD[1], _about(PERIOD[2])))


def save_block(dataset, path, block):
    """Save what `compute` returned for `block`."""
    dataset = dataset.assign_attrs(_attributes(block))
    dataset.attrs["content"] = artifacts.content_hash(dataset)
    with _writing(path) as file:
        _declare(file, dict(dataset.sizes), ("cell",), dataset.attrs)
        for name, variable in dataset.variables.items():
            file[name][...] = variable.values


def load_block(path, block) -> dict[str, np.ndarray]:
    """The arrays of the block at `path`; StoreError if it is damaged or not the block expected."""
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            variables = {
                name: (v.dimensions, v[...], {key: v.getncattr(key) for key in v.ncattrs()})
                for name, v in file.variables.items()
            }
            attrs = {key: file.getncattr(key) for key in file.ncattrs()}
        dataset = xr.Dataset(variables, attrs=attrs)
    except (OSError, RuntimeError, ValueError, UnicodeDecodeError) as error:
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        raise StoreError(f"{path}: damaged, or not netCDF ({reason})") from error
    content = dataset.attrs.pop("content", None)
    if content != artifacts.content_hash(dataset):
        raise StoreError(f"{path}: damaged: its content does not fit its own hash")
    if dataset.attrs.get("config") != artifacts.canonical_json(block):
        raise StoreError(f"{path}: holds other cells, or other orbits of them")
    return {name: variable.values for name, variable in dataset.variables.items()}


def join(sweep, blocks, path, record):
    """Join blocks into the dataset at `path`, with dims (k, energy), and note its sha256.

    Args:
        sweep: as from grid.whole.
        blocks: (path, block) of each in the order of their cells, as from grid.block.
        path, record: where to write the dataset, and the line of sha256sum.
    """
    across = len(sweep["energy"])
    sizes = {"k": len(sweep["k"]), "energy": across, "period": PERIODS}
    with _writing(path) as file:
        _declare(file, sizes, ("k", "energy"), _attributes(sweep))
        file["period"][...] = PERIOD[1]
        for axis in AXES:
            file[axis][...] = sweep[axis]
        start = 0
        for source, block in blocks:
            values = load_block(source, block)
            stop = start + len(block["cells"])
            for row in range(start // across, -(-stop // across)):
                first, last = max(start, row * across), min(stop, (row + 1) * across)
                for name in VARIABLES:
                    part = values[name][first - start : last - start]
                    file[name][row, first - row * across : last - row * across] = part
            start = stop
    with replacing(record) as part:
        part.write_text(f"{file_hash(path)}  {path.rsplit('/', 1)[-1]}\n", encoding="utf-8")


def intact(path, record) -> bool:
    """Whether the dataset at `path` has the sha256 that was noted."""
    try:
        with open(record, encoding="utf-8") as file:
            return file.read(64) == file_hash(path)
    except (OSError, ValueError):
        return False


def load(path) -> xr.Dataset:
    """The dataset of a sweep, in memory."""
    try:
        with xr.open_dataset(path) as file:
            return file.load()
    except (OSError, RuntimeError, ValueError) as error:
        raise StoreError(f"{path}: damaged, or not netCDF; run ./reproduce sweep again") from error


@contextmanager
def _writing(path):
    """A netCDF file that replaces `path` when it is complete."""
    try:
        with replacing(path) as part, netCDF4.Dataset(part, "w", format="NETCDF4") as file:
            yield file
    except StoreError:
        raise
    except (OSError, RuntimeError) as error:
        free = shutil.disk_usage(".").free / 1e6
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        message = f"{path}: cannot be written ({reason}); its disk has {free:.1f} MB left"
        raise StoreError(message) from error


def _declare(file, sizes, cells, attrs):
    """Dimensions and variables, in a fixed order; those of a cell have the dims `cells`."""
    file.setncatts({key: attrs[key] for key in sorted(attrs)})
    for dim in sorted(sizes):
        file.createDimension(dim, sizes[dim])
    for name, text in AXES.items():
        dims = cells if cells == ("cell",) else (name,)
        file.createVariable(name, "f8", dims, fill_value=False).setncatts(_about(text))
    file.createVariable("period", "i8", ("period",), fill_value=False).setncatts(_about(PERIOD[2]))
    for name, (text, kind) in VARIABLES.items():
        file.createVariable(name, kind, _dims(name, *cells), fill_value=False).setncatts(
            _about(text)
        )


def _attributes(config):
    return {"Conventions": artifacts.CONVENTIONS, "config": artifacts.canonical_json(config)}


def _dims(name, *cells):
    return (*cells, "period") if name == "chains" else cells


def _about(text):
    return {"long_name": text, "units": "1"}
