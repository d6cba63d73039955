"""What an article states of CITATION.cff, a file in the Citation File Format."""

from typing import Any

import yaml

from pipeline.records.files import read_text
from pipeline.records.sources import ROOT

CITATION = "CITATION.cff"
Citation = dict[str, Any]


def read() -> Citation:
    """Return the content of CITATION.cff."""
    content: Citation = yaml.safe_load(read_text(ROOT / CITATION))
    return content


def missing(cff: Citation) -> list[str]:
    """Return what a publication still needs and nobody has given, in words."""
    people = [author for author in cff["authors"] if "family-names" in author]
    needed = {
        "names of the authors": bool(people),
        "ORCIDs of the authors": bool(people) and all("orcid" in person for person in people),
        "repository-code, the repository's address": "repository-code" in cff,
        "doi, of the archived software": "doi" in cff,
        "date-released": "date-released" in cff,
    }
    return [words for words, present in needed.items() if not present]


def title(cff: Citation) -> str:
    """Return the title of a replication of the paper that CITATION.cff refers to."""
    return f"[Re] {cff['references'][0]['title']}"


def name_of(author: Citation) -> str:
    """Return the full name of a person or of a group of CITATION.cff."""
    return author.get("name") or f"{author['given-names']} {author['family-names']}"


def addresses(cff: Citation) -> list[str]:
    """Return the addresses of the repository and of the archived software, as far as given."""
    forms = {"repository-code": "{}", "doi": "https://doi.org/{}"}
    return [form.format(cff[key]) for key, form in forms.items() if key in cff]
