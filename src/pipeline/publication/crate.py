"""ro-crate-metadata.json of an archive: which step made which file from which files.

The archive is a Provenance Run Crate, version 0.5 (https://w3id.org/ro/wfrun/provenance/0.5), of
RO-Crate 1.1. The description is made from the records in the archive and from the metadata, so it
has the same bytes wherever the same results are archived. Times and machines are not in it.
"""

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import version
from pathlib import PurePosixPath
from typing import Any

from ..config.schema.stages import STAGES
from . import metadata

FILE = "ro-crate-metadata.json"
WORKFLOW = "Snakefile"
_RO_CRATE = "https://w3id.org/ro/crate/1.1"
_WORKFLOW_CRATE = "https://w3id.org/workflowhub/workflow-ro-crate/1.0"
_RUN_CRATE = "https://w3id.org/ro/wfrun"
_PROFILES = {
    f"{_RUN_CRATE}/process/0.5": "Process Run Crate",
    f"{_RUN_CRATE}/workflow/0.5": "Workflow Run Crate",
    f"{_RUN_CRATE}/provenance/0.5": "Provenance Run Crate",
    _WORKFLOW_CRATE: "Workflow RO-Crate",
}
_SNAKEMAKE = "https://snakemake.readthedocs.io"
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
    terms = {"sha256": "https://w3id.org/ro/terms/workflow-run#sha256"}
    graph = {
        "@context": [f"{_RO_CRATE}/context", terms],
        "@graph": [_plain(entity) for entity in _entities(archived)],
    }
    return f"{json.dumps(graph, indent=1, ensure_ascii=False)}\n".encode()


def _plain(entity: Entity) -> Entity:
    """Write a list of one value as that value, and leave empty lists out, as RO-Crate asks."""
    return {
        key: value[0] if isinstance(value, list) and len(value) == 1 else value
        for key, value in entity.items()
        if value != []
    }


def _entity(identifier: str, kind: str | list[str], name: str, /, **properties: Any) -> Entity:
    return {"@id": identifier, "@type": kind, "name": name, **properties}


def _ref(identifier: str) -> Entity:
    """Return a reference to an entity."""
    return {"@id": identifier}


def _refs(identifiers: Iterable[object], form: str = "{}") -> list[Entity]:
    return [_ref(form.format(identifier)) for identifier in identifiers]


def _entities(archived: Mapping[str, bytes]) -> Iterator[Entity]:
    facts = metadata.parsed(archived[metadata.CITATION].decode())
    hashes = {path: hashlib.sha256(data).hexdigest() for path, data in archived.items()}
    records = _records(archived)
    steps = sorted({step for _, step, _ in records})
    title, license_page = facts["title"], f"https://spdx.org/licenses/{facts['license']}"
    authors = _refs(range(len(facts["authors"])), "#author-{}")
    profiles = _refs((_RO_CRATE, _WORKFLOW_CRATE))
    yield {"@id": FILE, "@type": "CreativeWork", "about": _ref("./"), "conformsTo": profiles}
    yield _entity(
        "./",
        "Dataset",
        title,
        description=facts["abstract"],
        datePublished=str(facts.get("date-released", metadata.OWN["described"])),
        license=_ref(license_page),
        author=authors,
        keywords=", ".join(facts["keywords"]),
        mainEntity=_ref(WORKFLOW),
        conformsTo=_refs(_PROFILES),
        hasPart=_refs(archived),
        mentions=[_ref("#run"), *_refs((path for path, _, _ in records), "#action-{}")],
    )
    for profile, name in _PROFILES.items():
        yield _entity(profile, "CreativeWork", name, version=profile.rpartition("/")[2])
    for reference, author in zip(authors, facts["authors"], strict=True):
        kind = "Person" if "family-names" in author else "Organization"
        yield _entity(reference["@id"], kind, metadata.name_of(author))
    yield _entity(license_page, "CreativeWork", facts["license"])
    for path, data in archived.items():
        encoding = _TYPES.get(PurePosixPath(path).suffix, "text/plain")
        entity = _entity(path, "File", path, sha256=hashes[path])
        entity |= {"contentSize": str(len(data)), "encodingFormat": encoding}
        if path == WORKFLOW:
            kinds = ["File", "SoftwareSourceCode", "ComputationalWorkflow", "HowTo"]
            entity |= {"@type": kinds, "name": title, "author": authors}
            entity |= {"version": facts["version"], "license": _ref(license_page)}
            entity |= {"programmingLanguage": _ref("#snakemake-language")}
            entity |= {"input": _refs(["#parameter-config"])}
            entity |= {"hasPart": _refs(steps, "#tool-{}"), "step": _refs(steps, "#step-{}")}
        yield entity
    doi = _ref("https://doi.org/10.1093/bioinformatics/bts480")
    page = {"url": _ref(_SNAKEMAKE)}
    yield _entity("#snakemake-language", "ComputerLanguage", "Snakemake", identifier=doi, **page)
    number = version("snakemake")
    yield _entity("#snakemake", "SoftwareApplication", "Snakemake", softwareVersion=number, **page)
    yield _entity(
        "#parameter-config",
        "FormalParameter",
        "config",
        additionalType="File",
        encodingFormat=_TYPES[".yaml"],
        workExample=_ref("config.yaml"),
    )
    for i, step in enumerate(steps, 1):
        tool = f"#tool-{step}"
        yield _entity(tool, "SoftwareApplication", step, softwareVersion=facts["version"])
        yield _entity(f"#step-{step}", "HowToStep", step, position=str(i), workExample=_ref(tool))
    by_hash = {digest: path for path, digest in hashes.items()}
    yield from _actions(records, by_hash, title)


def _actions(
    records: list[tuple[str, str, Entity]], by_hash: dict[str, str], title: str
) -> Iterator[Entity]:
    """Yield the run of the workflow, and for each record what was done and what controlled it."""
    results = []
    for path, step, record in records:
        output = record["output"]
        made = [by_hash[digest] for digest in [str(output["sha256"])] if digest in by_hash]
        digests = [str(digest) for digest in record["inputs"].values()]
        inputs = [by_hash[digest] for digest in digests if digest in by_hash]
        results += made
        yield _entity(
            f"#action-{path}",
            "CreateAction",
            f"{step}: {output['file']}",
            instrument=_ref(f"#tool-{step}"),
            object=_refs(("config.yaml", *inputs)),
            result=_refs(made),
            subjectOf=_ref(path),
            description="; ".join(f"{n} {v}" for n, v in record["environment"].items()),
        )
        yield _entity(
            f"#control-{path}",
            "ControlAction",
            f"orchestrate {output['file']}",
            instrument=_ref(f"#step-{step}"),
            object=_ref(f"#action-{path}"),
        )
    yield _entity(
        "#run",
        "CreateAction",
        f"run of {title}",
        instrument=_ref(WORKFLOW),
        object=_refs(["config.yaml"]),
        result=_refs(dict.fromkeys(results)),
    )
    yield _entity(
        "#orchestration",
        "OrganizeAction",
        "execution by Snakemake",
        instrument=_ref("#snakemake"),
        object=_refs((path for path, _, _ in records), "#control-{}"),
        result=_ref("#run"),
    )


def _records(archived: Mapping[str, bytes]) -> list[tuple[str, str, Entity]]:
    """Return path, step and content of each record in the archive that says what it is about."""
    records = []
    for path, data in archived.items():
        if "/provenance/" in path and data:
            match record := json.loads(data):
                case {
                    "output": {"file": str(file), "sha256": _},
                    "inputs": dict(),
                    "environment": dict(),
                }:
                    records.append((path, _step(file), record))
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
