"""What article.typ takes from the results, as JSON: numbers, verdicts, captions and hashes."""

import hashlib
import json
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from extensions.claims import ledger as claims
from extensions.claims.ledger.outcomes import VERDICT_WORDS
from extensions.proofs.theorems.statements import THEOREMS
from pipeline.checks import manifest, published_sets
from pipeline.checks.quantities import measured, printed
from pipeline.checks.report.captions import caption_of
from pipeline.config import PAPER, PUBLISHED, Config
from pipeline.records.files import read_text
from pseudorigid.dynamics.paper import EXPONENT

from .. import citation

_HASH_DIGITS = 16  # of a dataset's hash
Table = dict[str, Any]
# scene -> axis -> the labels that the paper prints at its ticks
PRINTED_TICKS: dict[str, dict[str, list[float]]] = tomllib.loads(
    Path(__file__).with_name("printed_ticks.toml").read_text(encoding="utf-8")
)


def numbers_of(root: Path, config: Config) -> str:
    """Return the JSON text for a tree whose results are current and as committed.

    Raises ValueError, which names the file, if a manifest is missing or broken.
    """
    cff = citation.read()
    verdicts = claims.read_json(read_text(root / claims.DATA))
    counts = Counter(row.verdict for row in verdicts)
    sets = published_sets.committed_sets(config)
    try:
        committed = {each.folder: manifest.read(root, each.folder) for each in sets}
    except published_sets.ChecksumError as error:
        raise ValueError(str(error)) from None
    figures: dict[str, Table] = {}
    for each in sets:
        for scene, entry in committed[each.folder]["scenes"].items():
            name = f"{each.group}-{scene}" if scene in figures else scene
            figures[name] = _figure(root, each, scene, entry, committed[each.folder]["data"])
    for scene, entry in committed[PUBLISHED[PAPER]]["scenes"].items():
        figures[scene] |= {"rows": _rows(root, config, scene), "settings": entry["config"]}
    return json.dumps(
        {
            "title": citation.title(cff),
            "authors": [_author(author) for author in cff["authors"]],
            "missing": citation.missing(cff),
            "date": str(cff.get("date-released", "")),
            "addresses": citation.addresses(cff),
            "keywords": cff["keywords"],
            "version": cff["version"],
            "claims": [asdict(row) for row in verdicts],
            "counts": {word: counts[word] for word in VERDICT_WORDS},
            "statements": claims.checkable_count(verdicts),
            "figures": figures,
            "printed": {"exponent": EXPONENT},
            "lines": _source_lines(root),
            "theorems": [{"name": t.name, "statement": t.statement} for t in THEOREMS.values()],
            "packages": committed[PUBLISHED[PAPER]]["environment"],
        },
        sort_keys=True,
        indent=1,
        ensure_ascii=False,
    )


def _author(author: Table) -> Table:
    """Return name and ORCID of an author of CITATION.cff."""
    return {"name": citation.name_of(author), "orcid": author.get("orcid", "")}


def _source_lines(root: Path) -> dict[str, int]:
    """Return the lines of Python of the science alone, and of everything."""
    folders = {"science": "src/pseudorigid", "all": "src"}
    return {
        name: sum(read_text(file).count("\n") for file in sorted((root / folder).rglob("*.py")))
        for name, folder in folders.items()
    }


def _rows(root: Path, config: Config, scene: str) -> Table:
    """Return quantity -> the paper's value and ours: measured ones, then the ticks of the axes."""
    values = measured(root, config.variants, PAPER, scene)
    rows = {name: {"paper": printed(scene, name), "ours": ours} for name, ours in values.items()}
    axes = config.scenes[scene].given_axes()
    return rows | {
        f"ticks, {axis}": {"paper": _listed(ticks), "ours": _listed(axes[axis].ticks)}
        for axis, ticks in PRINTED_TICKS[scene].items()
    }


def _listed(ticks: list[float]) -> str:
    """Return the labels of ticks with commas between them."""
    return ", ".join(f"{tick:g}" for tick in ticks)


def _figure(
    root: Path, published: published_sets.PublishedSet, scene: str, entry: Table, data: Table
) -> Table:
    """Return what the article says of a committed picture."""
    caption = caption_of(scene, entry["config"])
    # For print an SVG file if there is one, for the web page the file that loads faster.
    files = [f"{published.folder}/{name}" for name in sorted(entry["figures"])]
    return {
        "title": caption.title[0].upper() + caption.title[1:],
        "shows": caption.shows,
        "file": files[-1],
        "web_file": min(files, key=lambda file: (root / file).stat().st_size),
        "scene": scene,
        "command": published.command,
        "datasets": list(_datasets(entry["data"].values(), data)),
    }


def _datasets(files: Iterable[str], data: Table) -> Iterator[Table]:
    """Yield file and hash of each dataset of a picture."""
    for file in sorted(Path(path).name for path in files):
        variables = data[file]["variables"]
        digests = "".join(variables[name]["sha256"] for name in sorted(variables))
        yield {"file": file, "hash": hashlib.sha256(digests.encode()).hexdigest()[:_HASH_DIGITS]}
