"""What article.typ takes from the results, as JSON: numbers, verdicts, captions and hashes."""

import hashlib
import json
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

from pseudorigid.dynamics.paper import EXPONENT
from pseudorigid.proofs.theorems.statements import THEOREMS

from ...checks import claims, manifest, published_sets
from ...checks.claims.schema import VERDICT_WORDS
from ...checks.quantities import measured, printed
from ...checks.report.captions import caption_of
from ...config import PAPER, PUBLISHED, paths
from ...records.files import read_text
from .. import citation

_HASH_DIGITS = 16  # of a hash in a caption
Table = dict[str, Any]


def numbers_of(root: Path, checked: Table) -> str:
    """Return the JSON text for a tree whose results are current and as committed.

    Raises ValueError, which names the file, if a manifest is missing or broken.
    """
    facts = citation.read()
    verdicts = claims.read_json(read_text(root / paths.LEDGER_DATA))
    counts = Counter(row.verdict for row in verdicts)
    sets = published_sets.committed_sets(checked)
    try:
        committed = {each.folder: manifest.read(root, each.folder) for each in sets}
    except published_sets.ChecksumError as error:
        raise ValueError(str(error)) from None
    figures = {
        scene: _figure(each.folder, each.command, scene, entry, committed[each.folder]["data"])
        for each in sets
        for scene, entry in committed[each.folder]["scenes"].items()
    }
    for scene, entry in committed[PUBLISHED[PAPER]]["scenes"].items():
        figures[scene] |= {"rows": _rows(root, checked, scene), "settings": entry["config"]}
    return json.dumps(
        {
            "title": citation.title(facts),
            "authors": [citation.name_of(author) for author in facts["authors"]],
            "addresses": citation.addresses(facts),
            "keywords": facts["keywords"],
            "version": facts["version"],
            "claims": [asdict(row) for row in verdicts],
            "counts": {word: counts[word] for word in VERDICT_WORDS},
            "statements": claims.checkable(verdicts),
            "figures": figures,
            "printed": {"exponent": EXPONENT},
            "theorems": [{"name": t.name, "statement": t.statement} for t in THEOREMS.values()],
            "packages": committed[PUBLISHED[PAPER]]["environment"],
        },
        sort_keys=True,
        indent=1,
        ensure_ascii=False,
    )


def _rows(root: Path, checked: Table, scene: str) -> Table:
    """Return quantity -> the paper's value and the one measured in a scene's datasets."""
    values = measured(root, checked["variants"], PAPER, scene)
    return {name: {"paper": printed(scene, name), "ours": ours} for name, ours in values.items()}


def _figure(folder: str, command: str, scene: str, entry: Table, data: Table) -> Table:
    """Return what the article says of a committed picture."""
    caption = caption_of(scene, entry["config"])
    title = caption.title[0].upper() + caption.title[1:]
    hashes = []
    for file in sorted(Path(path).name for path in entry["data"].values()):
        variables = data[file]["variables"]
        digests = "".join(variables[name]["sha256"] for name in sorted(variables))
        digest = hashlib.sha256(digests.encode()).hexdigest()[:_HASH_DIGITS]
        hashes.append(f"{file} {digest}")
    # The SVG file of the picture if it has one, else its PNG file.
    file = min(entry["figures"], key=lambda name: not name.endswith(".svg"))
    return {
        "name": caption.name,
        "title": title if caption.name == scene else f"{caption.name}: {caption.title}",
        "shows": caption.shows,
        "see": caption.see,
        "file": f"{folder}/{file}",
        "scene": scene,
        "command": command,
        "datasets": ", ".join(hashes),
    }
