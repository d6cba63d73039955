"""Metadata files for archives, catalogues and journals, made from one source.

Run `.venv/bin/python -m pipeline.publication.metadata` to renew them. CITATION.cff is the source;
metadata.toml beside this file has what its format cannot hold. A fact that nobody has given, such
as a DOI, is left out where the format allows it, and otherwise left empty with a comment.
"""

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml

from ..checks import manifest, published_sets
from ..checks.report.captions import caption_of
from ..config import load
from ..records.files import read_text, write_whole
from ..records.sources import ROOT

CITATION = "CITATION.cff"
TO_FILL_IN = "to be filled in"
OWN = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
Facts = dict[str, Any]


def citation() -> Facts:
    """Return the content of CITATION.cff."""
    return parsed(read_text(ROOT / CITATION))


def parsed(text: str) -> Facts:
    """Return the content of a text in the format of CITATION.cff."""
    facts: Facts = yaml.safe_load(text)
    return facts


def missing(facts: Facts) -> list[str]:
    """Return what a publication still needs and nobody has given, in words."""
    people = [author for author in facts["authors"] if "family-names" in author]
    needed = {
        "names of the authors": bool(people),
        "ORCIDs of the authors": bool(people) and all("orcid" in person for person in people),
        "repository-code, the repository's address": "repository-code" in facts,
        "doi, of the archived software": "doi" in facts,
        "date-released": "date-released" in facts,
    }
    return [words for words, given in needed.items() if not given]


def _reference(facts: Facts, between: str) -> str:
    """Return the reference of the paper that is replicated, with its authors joined."""
    paper = facts["references"][0]
    authors = between.join(map(name_of, paper["authors"]))
    return f"{authors}, {paper['title']}, {paper['journal']}"


def name_of(author: Facts) -> str:
    """Return the full name of a person or of a group of CITATION.cff."""
    return author.get("name") or f"{author['given-names']} {author['family-names']}"


def addresses(facts: Facts) -> list[str]:
    """Return the addresses of the repository and of the archived software, as far as given."""
    forms = {"repository-code": "{}", "doi": "https://doi.org/{}"}
    return [form.format(facts[key]) for key, form in forms.items() if key in facts]


def _codemeta(facts: Facts) -> Facts:
    project = tomllib.loads(read_text(ROOT / "pyproject.toml"))["project"]
    paper = facts["references"][0]
    return _given(
        {
            "@context": "https://w3id.org/codemeta/3.0",
            "@type": "SoftwareSourceCode",
            "name": facts["title"],
            "description": facts["abstract"],
            "version": facts["version"],
            "license": f"https://spdx.org/licenses/{facts['license']}",
            "keywords": facts["keywords"],
            "author": list(map(_agent, facts["authors"])),
            "programmingLanguage": OWN["language"],
            "runtimePlatform": f"{OWN['language']} {project['requires-python']}",
            "operatingSystem": OWN["systems"],
            "softwareRequirements": [
                {"@type": "SoftwareSourceCode", "name": package}
                for package in project["dependencies"]
            ],
            "referencePublication": {
                "@type": "ScholarlyArticle",
                "name": paper["title"],
                "author": list(map(_agent, paper["authors"])),
                "isPartOf": {"@type": "Periodical", "name": paper["journal"]},
            },
            "codeRepository": facts.get("repository-code"),
            "identifier": facts.get("doi"),
            "datePublished": facts.get("date-released"),
        }
    )


def _given(facts: Facts) -> Facts:
    """Leave out what nobody has given."""
    return {key: value for key, value in facts.items() if value is not None}


def _agent(author: Facts) -> Facts:
    """Return an author in the terms of schema.org."""
    if "name" in author:
        return {"@type": "Organization", "name": author["name"]}
    names = {"givenName": author["given-names"], "familyName": author["family-names"]}
    return _given({"@type": "Person", "@id": author.get("orcid"), **names})


def _zenodo(facts: Facts) -> Facts:
    creators = []
    for author in facts["authors"]:
        name = author.get("name") or f"{author['family-names']}, {author['given-names']}"
        orcid = author.get("orcid", "").rpartition("/")[2]
        creators.append(_given({"name": name, "orcid": orcid or None}))
    return {
        "title": facts["title"],
        "description": facts["abstract"],
        "upload_type": "software",
        "access_right": "open",
        "license": facts["license"],
        "version": facts["version"],
        "keywords": facts["keywords"],
        "creators": creators,
        "references": [_reference(facts, " and ")],
    }


def _rescience(facts: Facts) -> Facts:
    paper = facts["references"][0]
    fields = {"orcid": "orcid", "email": "email", "affiliations": "affiliation"}
    of_authors = [
        {"name": name_of(author)} | {name: author.get(key, "") for name, key in fields.items()}
        for author in facts["authors"]
    ]
    repository, doi = facts.get("repository-code", ""), facts.get("doi", "")
    return {
        "title": OWN["article"],
        "authors": of_authors,
        "affiliations": [],
        "abstract": facts["abstract"],
        "code": [{"url": repository}, {"doi": doi}, {"swh": ""}],
        "data": [{"url": ""}, {"doi": doi}],
        "replication": [
            {"cite": _reference(facts, ", ")},
            {"bib": ""},
            {"url": paper.get("url", "")},
            {"doi": paper.get("doi", "")},
        ],
        "contact": {"name": "", "email": ""},
        "review": [{"url": ""}],
        "dates": [{"received": ""}, {"accepted": ""}, {"published": ""}],
        "editors": [{"name": "", "orcid": ""}],
        "reviewers": [{"name": "", "orcid": ""}],
        "article": [{"number": ""}, {"doi": ""}, {"url": ""}],
        "journal": [{"name": "ReScience C"}, {"issn": "2430-3658"}, {"volume": ""}, {"issue": ""}],
        "language": OWN["language"],
        "domain": OWN["domain"],
        "keywords": ", ".join(facts["keywords"]),
        "type": "Replication",
    }


def _codecheck(facts: Facts) -> Facts:
    return {
        "version": "https://codecheck.org.uk/spec/config/1.0/",
        "source": facts.get("repository-code", ""),
        "paper": {
            "title": OWN["article"],
            "authors": [
                _given({"name": name_of(author), "ORCID": author.get("orcid")})
                for author in facts["authors"]
            ],
            "reference": facts.get("doi", ""),
        },
        "manifest": list(_published_figures()),
        "summary": " ".join(OWN["summary"].split()),
    }


def _published_figures() -> list[Facts]:
    """Return file and comment of every committed picture."""
    figures = []
    for published_set in published_sets.committed_sets(load(ROOT / "config.yaml")):
        folder = published_set.folder
        for scene, entry in manifest.read(ROOT, folder)["scenes"].items():
            caption = caption_of(scene, entry["config"])
            for name in entry["figures"]:
                comment = f"{caption.name}: {caption.title}; made by {published_set.command}"
                figures.append({"file": f"{folder}/{name}", "comment": comment})
    return figures


def _yaml(made: Facts) -> str:
    """Return YAML in which each empty value has a comment that it is to be filled in."""
    head = "# Written by `.venv/bin/python -m pipeline.publication.metadata` from CITATION.cff.\n"
    text = yaml.safe_dump(made, sort_keys=False, allow_unicode=True, width=100)
    lines = text.replace(": ''\n", f": ''  # {TO_FILL_IN}\n")
    return head + lines


def _json(made: Facts) -> str:
    return json.dumps(made, indent=2, ensure_ascii=False) + "\n"


_FORMATS: dict[str, tuple[Callable[[Facts], Facts], Callable[[Facts], str]]] = {
    "codemeta.json": (_codemeta, _json),
    ".zenodo.json": (_zenodo, _json),
    "metadata.yaml": (_rescience, _yaml),
    "codecheck.yml": (_codecheck, _yaml),
}


def pages() -> dict[str, str]:
    """Return the text of each metadata file by its name in the project's folder."""
    facts = citation()
    return {name: text(content(facts)) for name, (content, text) in _FORMATS.items()}


def main() -> None:
    """Write all metadata files, and print what is to be filled in."""
    for name, text in pages().items():
        write_whole(ROOT / name, text)
        print(name)
    for words in missing(citation()):
        print(f"{TO_FILL_IN} in {CITATION}: {words}")


if __name__ == "__main__":
    main()
