"""MANIFEST.json: the records of the results behind the published files of a folder.

The entry of a result is its record without what belongs to one machine. It also describes the data,
or the drawing and what its caption says. What records share stands once: environment, hashes of
sources, lists of sources. Nothing in a manifest depends on the day, the folder or the commit.
"""

import hashlib
import json
from pathlib import Path
from typing import Any

import xarray as xr

from ..records.artifacts import canonical_json, canonical_values, load, plain_attributes
from ..records.files import ABSENT, FileError, file_hash, read_text
from ..records.pictures import drawing_hash
from ..records.provenance import read_record, record_path
from .published_sets import MANIFEST, SUMS, PublishedSet, format_sums
from .quantities import facts

# `environment` (package -> version), `texts` and `sources` (path -> hash), and `results` (path ->
# entry). The `sources` of an entry are files, or the result that has the same ones.
Manifest = dict[str, Any]


def describe_data(dataset: xr.Dataset) -> dict[str, Any]:
    """Describe a dataset by hashes of its attributes and variables."""
    variables = {}
    for name, variable in dataset.variables.items():
        dtype, values = canonical_values(variable)
        data = json.dumps(values).encode() if isinstance(values, list) else values.tobytes()
        variables[str(name)] = {
            "dims": list(variable.dims),
            "shape": list(variable.shape),
            "dtype": dtype,
            "attributes": _attribute_hashes(variable),
            "sha256": hashlib.sha256(data).hexdigest(),
        }
    return {"attributes": _attribute_hashes(dataset), "variables": variables}


def _attribute_hashes(source: xr.Dataset | xr.Variable) -> dict[str, str]:
    """Map each attribute to a short hash of its value."""
    texts = ((name, json.dumps(value)) for name, value in plain_attributes(source).items())
    return {name: hashlib.sha256(text.encode()).hexdigest()[:16] for name, text in texts}


def build(root: Path, published_set: PublishedSet) -> Manifest:
    """Return the manifest of a set's results; ValueError or OSError if one cannot be read."""
    described = dict[str, dict[str, Any]]()
    for scene, stages in published_set.data.items():
        data = {stage: load(root / path) for stage, path in stages.items()}
        described |= {path: describe_data(data[stage]) for stage, path in stages.items()}
        drawings = [path for path in published_set.drawn.values() if Path(path).stem == scene]
        # All formats of a picture have one config, and the same facts.
        known = facts(published_set.build_specs[drawings[0]].config, data) if drawings else {}
        described |= {p: known | {"drawing": drawing_hash(root / p)} for p in drawings}
    records = {path: read_record(root, record_path(path)) for path in sorted(described)}
    shared = _shared([record["environment"] for record in records.values()])
    sources, results = dict[str, str](), dict[str, dict[str, Any]]()
    for path, record in records.items():
        sources |= record["sources"]
        files = [*record["sources"]]
        same = next((p for p, entry in results.items() if entry["sources"] == files), files)
        entry = {"sources": same, "output": record["output"] | described[path]}
        results[path] = entry | {name: record[name] for name in ("config", "inputs")}
        if further := {n: v for n, v in record["environment"].items() if n not in shared}:
            results[path]["environment"] = further
    texts = {path: file_hash(root / path) for path in published_set.text_files}
    return {"environment": shared, "texts": texts, "sources": sources, "results": results}


def _shared(mappings: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the entries that all mappings have."""
    first, *others = mappings or [{}]
    return {n: v for n, v in first.items() if all(n in each and each[n] == v for each in others)}


def record_of(manifest: Manifest, path: str) -> dict[str, Any]:
    """Return the whole record of a result in a manifest."""
    entry = manifest["results"][path]
    files = entry["sources"]
    files = manifest["results"][files]["sources"] if isinstance(files, str) else files
    sources = {file: manifest["sources"][file] for file in files}
    environment = manifest["environment"] | entry.get("environment", {})
    return {**entry, "sources": sources, "environment": environment}


def upstream(manifest: Manifest, path: str) -> list[str]:
    """Return a result of a manifest and the results in it that it is made from."""
    results, found = manifest["results"], [path]
    for each in found:
        found += [used for used in results[each]["inputs"] if used in results and used not in found]
    return found


def published(manifest: Manifest) -> dict[str, str]:
    """Map the name of each published file in a manifest to its drawing, sorted by name."""
    results = manifest["results"].items()
    return dict(sorted((Path(p).name, p) for p, each in results if "drawing" in each["output"]))


def read(root: Path, folder: str) -> Manifest:
    """Return a folder's manifest; raises FileError if it is missing, broken or was edited."""
    name = f"{folder}/{MANIFEST}"
    try:
        manifest = json.loads(read_text(root / name))
        # The checksum covers every entry, so that no entry can be lost or changed unnoticed.
        if not isinstance(manifest, dict) or manifest.pop("checksum", None) != _checksum(manifest):
            raise FileError(f"{name}: was edited: its content does not fit its own checksum")
        for path in manifest["results"]:
            record_of(manifest, path)
    except ABSENT:
        raise FileError(f"{name}: missing") from None
    except FileError as error:
        raise FileError(str(error).replace(f"{root}/", "")) from None
    except (ValueError, TypeError, LookupError, RecursionError) as error:
        raise FileError(f"{name}: broken: {error}") from None
    return manifest


def files_of(manifest: Manifest) -> dict[str, str]:
    """Return the texts of a manifest's file and of the checksum list, by the files' names."""
    results = manifest["results"]
    sums = {name: results[path]["output"]["sha256"] for name, path in published(manifest).items()}
    whole = manifest | {"checksum": _checksum(manifest)}
    return {MANIFEST: f"{json.dumps(whole, sort_keys=True, indent=1)}\n", SUMS: format_sums(sums)}


def _checksum(manifest: Manifest) -> str:
    """Return the hash of all entries of a manifest."""
    return hashlib.sha256(canonical_json(manifest).encode()).hexdigest()
