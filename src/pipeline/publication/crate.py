"""ro-crate-metadata.json of an archive: which step made which file from which files.

The archive is a Provenance Run Crate, version 0.5 (https://w3id.org/ro/wfrun/provenance/0.5), of
RO-Crate 1.1. The description is made from the records in the archive and from the metadata, so it
has the same bytes wherever the same results are archived. Times and machines are not in it.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
from importlib.metadata import version
from pathlib import PurePosixPath
from typing import Any

from ..config.schema.stages import STAGES
from . import metadata

FILE = "ro-crate-metadata.json"
WORKFLOW = "Snakefile"
_RO_CRATE = "https://w3id.org/ro/crate/1.1"
_TERMS = "https://w3id.org/ro/terms/workflow-run"
_PROFILES = {
    f"https://w3id.org/ro/wfrun/{name}/0.5": title
    for name, title in {
        "process": "Process Run Crate",
        "workflow": "Workflow Run Crate",
        "provenance": "Provenance Run Crate",
    }.items()
} | {"https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate"}
_TYPES = {
    ".nc": "application/x-netcdf",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".pdf": "application/pdf",
    ".json": "application/json",
    ".yaml": "application/yaml",
    ".toml": "application/toml",
    ".md": "text/markdown",
}
Entity = dict[str, Any]


def crate(archived: Mapping[str, bytes]) -> bytes:
    """Return the description of an archive with these files, CITATION.cff among them."""
    graph = json.dumps(
        {
            "@context": [f"{_RO_CRATE}/context", {"sha256": f"{_TERMS}#sha256"}],
            "@graph": [_plain(entity) for entity in _entities(archived)],
        },
        indent=1,
        ensure_ascii=False,
    )
    return f"{graph}\n".encode()


def _plain(entity: Entity) -> Entity:
    """Write a list of one value as that value, and leave empty lists out, as RO-Crate asks."""
    return {
        key: value[0] if isinstance(value, list) and len(value) == 1 else value
        for key, value in entity.items()
        if value != []
    }


def _entities(archived: Mapping[str, bytes]) -> Iterator[Entity]:
    facts = metadata.parsed(archived[metadata.CITATION].decode())
    hashes = {path: hashlib.sha256(data).hexdigest() for path, data in archived.items()}
    records = _records(archived)
    steps = {step for _, step, _ in records}
    yield {
        "@id": FILE,
        "@type": "CreativeWork",
        "about": {"@id": "./"},
        "conformsTo": [
            {"@id": _RO_CRATE},
            {"@id": "https://w3id.org/workflowhub/workflow-ro-crate/1.0"},
        ],
    }
    authors = [{"@id": f"#author-{i}"} for i in range(len(facts["authors"]))]
    yield {
        "@id": "./",
        "@type": "Dataset",
        "name": facts["title"],
        "description": facts["abstract"],
        "datePublished": str(facts.get("date-released", metadata.DESCRIBED)),
        "license": {"@id": f"https://spdx.org/licenses/{facts['license']}"},
        "author": authors,
        "keywords": ", ".join(facts["keywords"]),
        "mainEntity": {"@id": WORKFLOW},
        "conformsTo": [{"@id": profile} for profile in _PROFILES],
        "hasPart": [{"@id": path} for path in archived],
        "mentions": [{"@id": "#run"}, *({"@id": f"#action-{path}"} for path, _, _ in records)],
    }
    for profile, title in _PROFILES.items():
        number = profile.rpartition("/")[2]
        yield {"@id": profile, "@type": "CreativeWork", "name": title, "version": number}
    for i, author in enumerate(facts["authors"]):
        kind = "Person" if "family-names" in author else "Organization"
        yield {"@id": f"#author-{i}", "@type": kind, "name": metadata.name_of(author)}
    yield {
        "@id": f"https://spdx.org/licenses/{facts['license']}",
        "@type": "CreativeWork",
        "name": facts["license"],
    }
    for path, data in archived.items():
        entity: Entity = {"@id": path, "@type": "File", "name": path, "sha256": hashes[path]}
        entity |= {"contentSize": str(len(data)), "encodingFormat": _format(path)}
        if path == WORKFLOW:
            entity |= _workflow(facts, steps, authors)
        yield entity
    yield from _engine()
    for position, step in enumerate(sorted(steps), 1):
        yield {
            "@id": f"#tool-{step}",
            "@type": "SoftwareApplication",
            "name": step,
            "softwareVersion": facts["version"],
        }
        yield {
            "@id": f"#step-{step}",
            "@type": "HowToStep",
            "name": step,
            "position": str(position),
            "workExample": {"@id": f"#tool-{step}"},
        }
    by_hash = {digest: path for path, digest in hashes.items()}
    yield from _actions(records, by_hash, facts)


def _workflow(facts: Entity, steps: set[str], authors: list[Entity]) -> Entity:
    """Return the properties of the workflow's file beyond those of a file."""
    ordered = sorted(steps)
    return {
        "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow", "HowTo"],
        "name": facts["title"],
        "author": authors,
        "version": facts["version"],
        "license": {"@id": f"https://spdx.org/licenses/{facts['license']}"},
        "programmingLanguage": {"@id": "#snakemake-language"},
        "input": [{"@id": "#parameter-config"}],
        "hasPart": [{"@id": f"#tool-{step}"} for step in ordered],
        "step": [{"@id": f"#step-{step}"} for step in ordered],
    }


def _engine() -> Iterator[Entity]:
    """Yield the language, the engine and the workflow's parameter."""
    yield {
        "@id": "#snakemake-language",
        "@type": "ComputerLanguage",
        "name": "Snakemake",
        "identifier": {"@id": "https://doi.org/10.1093/bioinformatics/bts480"},
        "url": {"@id": "https://snakemake.readthedocs.io"},
    }
    yield {
        "@id": "#snakemake",
        "@type": "SoftwareApplication",
        "name": "Snakemake",
        "softwareVersion": version("snakemake"),
        "url": {"@id": "https://snakemake.readthedocs.io"},
    }
    yield {
        "@id": "#parameter-config",
        "@type": "FormalParameter",
        "name": "config",
        "additionalType": "File",
        "encodingFormat": _TYPES[".yaml"],
        "workExample": {"@id": "config.yaml"},
    }


def _actions(
    records: list[tuple[str, str, Entity]], by_hash: dict[str, str], facts: Entity
) -> Iterator[Entity]:
    """Yield the run of the workflow, and for each record what was done and what controlled it."""
    results = {}
    for path, step, record in records:
        made = by_hash.get(str(record["output"]["sha256"]))
        digests = [str(digest) for digest in record["inputs"].values()]
        inputs = [by_hash[digest] for digest in digests if digest in by_hash]
        if made:
            results[path] = made
        yield {
            "@id": f"#action-{path}",
            "@type": "CreateAction",
            "name": f"{step}: {record['output']['file']}",
            "instrument": {"@id": f"#tool-{step}"},
            "object": [{"@id": name} for name in ("config.yaml", *inputs)],
            "result": [{"@id": made}] if made else [],
            "subjectOf": {"@id": path},
            "description": "; ".join(f"{n} {v}" for n, v in record["environment"].items()),
        }
        yield {
            "@id": f"#control-{path}",
            "@type": "ControlAction",
            "name": f"orchestrate {record['output']['file']}",
            "instrument": {"@id": f"#step-{step}"},
            "object": {"@id": f"#action-{path}"},
        }
    yield {
        "@id": "#run",
        "@type": "CreateAction",
        "name": f"run of {facts['title']}",
        "instrument": {"@id": WORKFLOW},
        "object": [{"@id": "config.yaml"}],
        "result": [{"@id": made} for made in dict.fromkeys(results.values())],
    }
    yield {
        "@id": "#orchestration",
        "@type": "OrganizeAction",
        "name": "execution by Snakemake",
        "instrument": {"@id": "#snakemake"},
        "object": [{"@id": f"#control-{path}"} for path, _, _ in records],
        "result": {"@id": "#run"},
    }


def _records(archived: Mapping[str, bytes]) -> list[tuple[str, str, Entity]]:
    """Return path, step and content of each record in the archive that says what it is about."""
    records = []
    for path, data in archived.items():
        if "/provenance/" in path and data:
            record = json.loads(data)
            output, inputs, packages = (record[n] for n in ("output", "inputs", "environment"))
            named = isinstance(output, dict) and isinstance(output.get("file"), str)
            if (
                named
                and "sha256" in output
                and isinstance(inputs, dict)
                and isinstance(packages, dict)
            ):
                records.append((path, _step(output["file"]), record))
    return records


def _step(file: str) -> str:
    """Return the stage that made a dataset, or the drawing, from the name of its file."""
    path = PurePosixPath(file)
    if "figures" in path.parts or path.suffix != ".nc":
        return "draw"
    if path.parent.name == "sweep":
        return "sweep"
    stages = [stage for stage in STAGES if path.stem.startswith(f"{stage}_")]
    return stages[0] if stages else path.stem


def _format(path: str) -> str:
    return _TYPES.get(PurePosixPath(path).suffix, "text/plain")
