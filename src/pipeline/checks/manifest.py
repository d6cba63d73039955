"""A contract as written down: SHA256SUMS and MANIFEST.json, committed beside the files.

The manifest has, layer by layer, what these were made from: config, source, environment,
data, drawing, file. Nothing in it depends on the day, the folder or the commit.
"""

import hashlib
import json
from pathlib import Path

import pydantic

from ..records.artifacts import canonical_json, canonical_values, load, plain_attributes
from ..records.files import file_hash, write_whole
from ..records.pictures import describe
from ..records.record import versions
from ..records.sources import syntax_hash
from .checksums import SUMS, ChecksumError, text_of

MANIFEST = "MANIFEST.json"
BLOCK = 1024  # values hashed together, so that a difference can be placed
_SHORT = 16  # hex digits of the hash of a block or an attribute


class _Variable(pydantic.BaseModel):
    dims: list[str]
    shape: list[int]
    dtype: str
    attributes: dict[str, str]
    sha256: str
    blocks: str


class _Data(pydantic.BaseModel):
    attributes: dict[str, str]
    sizes: dict[str, int]
    variables: dict[str, _Variable]


class _Figure(pydantic.BaseModel):
    drawing: dict[str, int | str]
    sha256: str


class _Scene(pydantic.BaseModel):
    config: dict
    sources: list[str]
    data: dict[str, str]
    figures: dict[str, _Figure]


class _Manifest(pydantic.BaseModel):
    environment: dict[str, str | None]
    texts: dict[str, str | None]
    sources: dict[str, str | None]
    data: dict[str, _Data]
    scenes: dict[str, _Scene]


def describe_data(dataset):
    """What the manifest says of an artifact: hashes of its attributes and of its variables.

    A variable's values are hashed whole and in blocks of BLOCK; the container's bytes do not count.
    """
    variables = {}
    for name, variable in dataset.variables.items():
        kind, values = canonical_values(variable)
        blocks = [values[start : start + BLOCK] for start in range(0, len(values), BLOCK)]
        blocks = [_bytes(block) for block in blocks]
        variables[str(name)] = {
            "dims": list(variable.dims),
            "shape": list(variable.shape),
            "dtype": kind,
            "attributes": _attributes(variable),
            "sha256": hashlib.sha256(b"".join(blocks)).hexdigest(),
            "blocks": " ".join(_short(block) for block in blocks),
        }
    sizes = {str(name): size for name, size in dataset.sizes.items()}
    return {"attributes": _attributes(dataset), "sizes": sizes, "variables": variables}


def build(root, published_set):
    """The manifest of a tree that has its results and figures; raises ValueError or OSError."""
    artifacts = sorted({path for stages in published_set.data.values() for path in stages.values()})
    sources = {scene: published_set.sources(scene) for scene in published_set.config}
    return {
        "environment": versions(),
        "texts": {path: file_hash(root / path) for path in published_set.texts},
        "sources": {
            path: syntax_hash(root / path) for path in sorted(set().union(*sources.values()))
        },
        "data": {Path(path).name: describe_data(load(root / path)) for path in artifacts},
        "scenes": {
            scene: {
                "config": block,
                "sources": sources[scene],
                "data": {
                    stage: Path(path).name for stage, path in published_set.data[scene].items()
                },
                "figures": {
                    name: {
                        "drawing": describe(root / published_set.folder / name),
                        "sha256": file_hash(root / published_set.folder / name),
                    }
                    for name in sorted(published_set.drawn)
                    if published_set.scenes[name] == scene
                },
            }
            for scene, block in published_set.config.items()
        },
    }


def is_present(root, published_set):
    """Whether anything of a contract is committed."""
    return any((root / published_set.folder / name).exists() for name in (MANIFEST, SUMS))


def read(root, folder):
    """The committed manifest; raises ContractError if it is missing, broken or edited by hand."""
    name = f"{folder}/{MANIFEST}"
    try:
        manifest = json.loads(text_of(root, name))
        # It covers every entry: none can be lost or changed without a word.
        if not isinstance(manifest, dict) or manifest.pop("checksum", None) != _checksum(manifest):
            raise ChecksumError(f"{name}: was edited: its content does not fit its own checksum")
        _Manifest.model_validate(manifest, strict=True)
    except pydantic.ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ChecksumError(f"{name}: broken: {place}: {first['msg']}") from None
    except (ValueError, RecursionError) as error:
        raise ChecksumError(f"{name}: broken: {error}") from None
    return manifest


def figures(manifest):
    """File name -> its entry in the manifest."""
    return {
        name: entry
        for scene in manifest["scenes"].values()
        for name, entry in scene["figures"].items()
    }


def sums(manifest):
    """File name -> sha256, sorted."""
    return {name: entry["sha256"] for name, entry in sorted(figures(manifest).items())}


def write(root, folder, manifest):
    """Write both files of the contract."""
    text = json.dumps(manifest | {"checksum": _checksum(manifest)}, sort_keys=True, indent=1)
    write_whole(root / folder / MANIFEST, f"{text}\n")
    lines = [f"{digest}  {name}\n" for name, digest in sums(manifest).items()]
    write_whole(root / folder / SUMS, "".join(lines))


def _checksum(manifest):
    return hashlib.sha256(canonical_json(manifest).encode()).hexdigest()


def _attributes(source):
    return {
        str(name): _short(json.dumps(value).encode())
        for name, value in plain_attributes(source).items()
    }


def _bytes(block):
    return json.dumps(block).encode() if isinstance(block, list) else block.tobytes()


def _short(data):
    return hashlib.sha256(data).hexdigest()[:_SHORT]
