"""MANIFEST.json: what each figure of a folder of published files was made from, layer by layer.

The layers are config, source, environment, data, drawing and file. `verify` names the layers
in which a figure differs. Nothing in a manifest depends on the day, the folder or the commit.
"""

import hashlib
import json
from pathlib import Path
from typing import Any

import pydantic
import xarray as xr

from ..records.artifacts import canonical_json, canonical_values, load, plain_attributes
from ..records.files import file_hash, write_whole
from ..records.pictures import describe
from ..records.record import versions
from ..records.sources import syntax_hash
from . import published_sets
from .published_sets import MANIFEST, SUMS, ChecksumError, PublishedSet, format_sums
from .quantities import facts

BLOCK = 1024  # values that are hashed together, so that a difference can be located
_SHORT_DIGITS = 16  # hex digits of the hash of a block or an attribute

Manifest = dict[str, Any]  # with the fields of _Manifest


class _VariableEntry(pydantic.BaseModel):
    """A variable of a dataset; `blocks` has a short hash of each BLOCK of its values."""

    dims: list[str]
    shape: list[int]
    dtype: str
    attributes: dict[str, str]
    sha256: str
    blocks: str


class _DatasetEntry(pydantic.BaseModel):
    """A dataset: hashes of its attributes, sizes of its dims, variables."""

    attributes: dict[str, str]
    sizes: dict[str, int]
    variables: dict[str, _VariableEntry]


class _FileEntry(pydantic.BaseModel):
    """A published file: what `pictures.describe` returns, and its hash."""

    drawing: dict[str, int | str]
    sha256: str


class _SceneEntry(pydantic.BaseModel):
    """A scene: its block, what its caption says, sources, stage -> name of data, and its files."""

    config: dict[str, Any]
    facts: dict[str, Any]
    sources: list[str]
    data: dict[str, str]
    figures: dict[str, _FileEntry]


class _Manifest(pydantic.BaseModel):
    """Package -> version, path -> hash of texts and of sources, and datasets and scenes by name."""

    environment: dict[str, str | None]
    texts: dict[str, str | None]
    sources: dict[str, str | None]
    data: dict[str, _DatasetEntry]
    scenes: dict[str, _SceneEntry]


def describe_data(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the entry for a dataset in a manifest: hashes of its attributes and variables."""
    variables = {}
    for name, variable in dataset.variables.items():
        dtype, values = canonical_values(variable)
        slices = [values[start : start + BLOCK] for start in range(0, len(values), BLOCK)]
        blocks = [
            json.dumps(block).encode() if isinstance(block, list) else block.tobytes()
            for block in slices
        ]
        variables[str(name)] = {
            "dims": list(variable.dims),
            "shape": list(variable.shape),
            "dtype": dtype,
            "attributes": _attribute_hashes(variable),
            "sha256": hashlib.sha256(b"".join(blocks)).hexdigest(),
            "blocks": " ".join(_short_hash(block) for block in blocks),
        }
    sizes = {str(name): size for name, size in dataset.sizes.items()}
    return {"attributes": _attribute_hashes(dataset), "sizes": sizes, "variables": variables}


def build(root: Path, published_set: PublishedSet) -> Manifest:
    """Return the manifest of a set's files; ValueError or OSError if one cannot be read."""
    datasets = {path for stages in published_set.data.values() for path in stages.values()}
    sources = {scene: published_set.sources(scene) for scene in published_set.config}
    source_files = sorted(set().union(*sources.values()))
    folder = root / published_set.folder
    return {
        "environment": versions(),
        "texts": {path: file_hash(root / path) for path in published_set.text_files},
        "sources": {path: syntax_hash(root / path) for path in source_files},
        "data": {Path(path).name: describe_data(load(root / path)) for path in sorted(datasets)},
        "scenes": {
            scene: {
                "config": block,
                "facts": facts(
                    block, {s: load(root / path) for s, path in published_set.data[scene].items()}
                ),
                "sources": sources[scene],
                "data": {
                    stage: Path(path).name for stage, path in published_set.data[scene].items()
                },
                "figures": {
                    name: {"drawing": describe(folder / name), "sha256": file_hash(folder / name)}
                    for name in sorted(published_set.drawn)
                    if Path(name).stem == scene
                },
            }
            for scene, block in published_set.config.items()
        },
    }


def is_present(root: Path, published_set: PublishedSet) -> bool:
    """Return whether the folder of a published set has a manifest or a checksum list."""
    return any((root / published_set.folder / name).exists() for name in (MANIFEST, SUMS))


def read(root: Path, folder: str) -> Manifest:
    """Return a folder's manifest; raises ChecksumError if it is missing, broken or was edited."""
    name = f"{folder}/{MANIFEST}"
    try:
        manifest = json.loads(published_sets.read_published_text(root, name))
        # The checksum covers every entry, so that no entry can be lost or changed unnoticed.
        if not isinstance(manifest, dict) or manifest.pop("checksum", None) != _checksum(manifest):
            raise ChecksumError(f"{name}: was edited: its content does not fit its own checksum")
        _Manifest.model_validate(manifest, strict=True)
    except pydantic.ValidationError as error:
        first = error.errors()[0]
        key = ".".join(map(str, first["loc"]))
        raise ChecksumError(f"{name}: broken: {key}: {first['msg']}") from None
    except (ValueError, RecursionError) as error:
        raise ChecksumError(f"{name}: broken: {error}") from None
    return manifest


def sums(manifest: Manifest) -> dict[str, str]:
    """Map each file name of the figures in a manifest to its SHA-256, sorted by name."""
    figures = (item for scene in manifest["scenes"].values() for item in scene["figures"].items())
    return {name: figure["sha256"] for name, figure in sorted(figures)}


def is_listed(root: Path, folder: str, manifest: Manifest) -> bool:
    """Return whether a folder's checksum list has the sums of a manifest; raises ChecksumError."""
    return published_sets.read_published_text(root, f"{folder}/{SUMS}") == format_sums(
        sums(manifest)
    )


def write(root: Path, folder: str, manifest: Manifest) -> None:
    """Write the manifest and the checksum list of a folder."""
    text = json.dumps(manifest | {"checksum": _checksum(manifest)}, sort_keys=True, indent=1)
    write_whole(root / folder / MANIFEST, f"{text}\n")
    write_whole(root / folder / SUMS, format_sums(sums(manifest)))


def _checksum(manifest: Manifest) -> str:
    """Return the hash of all entries of a manifest."""
    return hashlib.sha256(canonical_json(manifest).encode()).hexdigest()


def _attribute_hashes(source: xr.Dataset | xr.Variable) -> dict[str, str]:
    """Map each attribute to a short hash of its value."""
    return {
        str(name): _short_hash(json.dumps(value).encode())
        for name, value in plain_attributes(source).items()
    }


def _short_hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:_SHORT_DIGITS]
