"""Facts of CITATION.cff that an article states."""

from typing import Any

import yaml

from pipeline.records.files import read_text
from pipeline.records.sources import ROOT

CITATION = "CITATION.cff"
Facts = dict[str, Any]


def read() -> Facts:
    """Return the content of CITATION.cff."""
    facts: Facts = yaml.safe_load(read_text(ROOT / CITATION))
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


def title(facts: Facts) -> str:
    """Return the title of a replication of the paper that CITATION.cff refers to."""
    return f"[Re] {facts['references'][0]['title']}"


def name_of(author: Facts) -> str:
    """Return the full name of a person or of a group of CITATION.cff."""
    return author.get("name") or f"{author['given-names']} {author['family-names']}"


def addresses(facts: Facts) -> list[str]:
    """Return the addresses of the repository and of the archived software, as far as given."""
    forms = {"repository-code": "{}", "doi": "https://doi.org/{}"}
    return [form.format(facts[key]) for key, form in forms.items() if key in facts]
