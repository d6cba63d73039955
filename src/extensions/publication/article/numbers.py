"""What article.typ takes from the results, as JSON: numbers, verdicts and captions.

Title, authors and addresses are those of CITATION.cff, a file in the Citation File Format.
"""

import json
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

import yaml

from extensions.claims import ledger as claims
from extensions.claims.ledger.outcomes import VERDICT_WORDS
from extensions.proofs.theorems.statements import THEOREMS
from paper.numbers import printed
from paper.values import EXPONENT
from pipeline.checks import manifest, published_sets
from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import measured
from pipeline.config import MAIN, PUBLISHED, Config
from pipeline.records.files import read_text
from pipeline.records.sources import ROOT

from .. import figures_page

CITATION = "CITATION.cff"
_ADDRESSES = {"repository-code": "{}", "doi": "https://doi.org/{}"}  # of CITATION.cff
Table = dict[str, Any]


def read_citation() -> Table:
    """Return the content of CITATION.cff."""
    content: Table = yaml.safe_load(read_text(ROOT / CITATION))
    return content


def missing(cff: Table) -> list[str]:
    """Return what a publication still needs and nobody has given in CITATION.cff, in words."""
    people = [author for author in cff["authors"] if "family-names" in author]
    needed = {
        "names of the authors": bool(people),
        "ORCIDs of the authors": bool(people) and all("orcid" in person for person in people),
        "repository-code, the repository's address": "repository-code" in cff,
        "doi, of the archived software": "doi" in cff,
        "date-released": "date-released" in cff,
    }
    return [words for words, present in needed.items() if not present]


def numbers_of(root: Path, config: Config) -> str:
    """Return the JSON text for a tree whose results are current and as committed.

    Raises ValueError, which names the file, if a manifest is missing or broken.
    """
    cff = read_citation()
    verdicts = claims.read_json(read_text(root / claims.DATA))
    counts = Counter(row.verdict for row in verdicts)
    sets = published_sets.committed_sets(config)
    committed = {each.folder: manifest.read(root, each.folder) for each in sets}
    figures: dict[str, Table] = {}
    for each in sets:
        drawings = manifest.published(committed[each.folder]).values()
        for scene, drawing in {Path(path).stem: path for path in drawings}.items():
            name = scene if each.group == MAIN else f"{each.group}/{scene}"
            figures[name] = _figure(root, each, name, committed[each.folder], drawing)
            if each.group == MAIN:
                settings = committed[each.folder]["results"][drawing]["config"]
                ours = measured(root, config, MAIN, scene)
                rows = {q: {"paper": printed(scene, q), "ours": value} for q, value in ours.items()}
                figures[name] |= {"rows": rows, "settings": settings}
    return json.dumps(
        {
            **_of_citation(cff),
            "claims": [asdict(row) for row in verdicts],
            "counts": {word: counts[word] for word in VERDICT_WORDS},
            "statements": claims.checkable_count(verdicts),
            "figures": figures,
            "printed": {"exponent": EXPONENT},
            "theorems": [{"name": t.name, "statement": t.statement} for t in THEOREMS.values()],
            "packages": _packages(committed[PUBLISHED[MAIN]]),
        },
        sort_keys=True,
        indent=1,
        ensure_ascii=False,
    )


def _packages(committed: Table) -> Table:
    """Return the packages that made the results of a manifest, with their versions."""
    records = (manifest.record_of(committed, path) for path in committed["results"])
    return {name: v for record in records for name, v in record["environment"].items()}


def _of_citation(cff: Table) -> Table:
    """Return what the article states of CITATION.cff; an author is a person or a group."""
    names = [a.get("name") or f"{a['given-names']} {a['family-names']}" for a in cff["authors"]]
    orcids = [author.get("orcid", "") for author in cff["authors"]]
    return {
        "title": f"[Re] {cff['references'][0]['title']}",
        "authors": [{"name": n, "orcid": o} for n, o in zip(names, orcids, strict=True)],
        "missing": missing(cff),
        "date": str(cff.get("date-released", "")),
        "addresses": [form.format(cff[key]) for key, form in _ADDRESSES.items() if key in cff],
        "keywords": cff["keywords"],
        "version": cff["version"],
    }


def _figure(
    root: Path, published: published_sets.PublishedSet, name: str, committed: Table, drawing: str
) -> Table:
    """Return what the article says of a committed picture."""
    entry = committed["results"][drawing]
    caption = caption_of(name, entry["config"], entry["output"])
    # For print an SVG file if there is one, for the web page the file that loads faster.
    files = [
        f"{published.folder}/{file}"
        for file in manifest.published(committed)
        if Path(file).stem == Path(drawing).stem
    ]
    return {
        "title": caption.title[0].upper() + caption.title[1:],
        "shows": caption.shows,
        "file": files[-1],
        "web_file": min(files, key=lambda file: (root / file).stat().st_size),
        "anchor": figures_page.anchor(f"{caption.name}: {caption.title}"),
        "datasets": sorted(Path(path).name for path in manifest.upstream(committed, drawing)[1:]),
    }
