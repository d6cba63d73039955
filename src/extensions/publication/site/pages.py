"""Pages that are written for each site: this run, the gallery, the theorems, and Python."""

import re
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pseudorigid
from extensions.claims import ledger
from extensions.claims.ledger.outcomes import CORRECTED, FALSE
from extensions.claims.mathematics import typeset
from extensions.explorer.data import address
from extensions.proofs.theorems.statements import THEOREMS
from paper.numbers import printed
from pipeline.checks import published_sets
from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import measured
from pipeline.config import MAIN, Config
from pipeline.config.results import drawn
from pipeline.config.schema.parts import SETS
from pipeline.records.artifacts import load
from pipeline.records.files import read_text
from pipeline.records.provenance import CURRENT, Freshness, read_record, record_path

from ..figures_page import anchor

_PROOFS = "src/extensions/proofs"
# Functions of parts, which are no part of the wheel.
_OF_PARTS = {
    "extensions.proofs": ("prove_orbit", "prove_curve", "prove_horseshoe", "true_orbit"),
    "extensions.claims": ("turnstile_flux",),
}


def pages(root: Path, config: Config) -> dict[str, str]:
    """Map each page, by its name, to its text in MyST; ValueError names a broken result."""
    written = {
        "run": _run(root, config),
        "gallery": _gallery(root, config),
        "api": _api(),
        **{f"theorem-{name}": _theorem(root, config, name) for name in THEOREMS},
    }
    return {name: "\n".join([*lines, ""]) for name, lines in written.items()}


def _table(head: Iterable[str], rows: Iterable[Iterable[object]]) -> list[str]:
    """Return the lines of a table, between empty lines."""
    lines = [[*head]]
    lines += [["---"] * len(lines[0]), *([str(cell) for cell in row] for row in rows)]
    return [
        "",
        *("| " + " | ".join(c.replace("|", "\\|") for c in line) + " |" for line in lines),
        "",
    ]


def _run(root: Path, config: Config) -> Iterator[str]:
    """Yield the page on this run: states, reported numbers, corrections, and seconds."""
    freshness, shown = Freshness(root, config.build_specs()), dict[str, None]()
    yield "# This run\n\nThis page was written with the site, from the results that are current."
    for variant in (MAIN, *config.own_variants):
        drawings = {scene: drawn(scene, "png", variant) for scene in config.variants[variant]}
        states = {scene: freshness.state(path) for scene, path in drawings.items()}
        if variant != MAIN and CURRENT not in states.values():
            continue
        yield f"\n## {'The figures' if variant == MAIN else f'Variant {variant}'}"
        for scene, state in (states | config.left_out.get(variant, {})).items():
            block = config.variants[variant].get(scene, config.scenes[scene]).as_mapping()
            caption = caption_of(scene, block)
            yield f"\n### {caption.name}: {caption.title}\n"
            if state != CURRENT:
                yield f"Not shown: {state}."
                continue
            shown |= dict.fromkeys([*config.data_of(variant, scene).values(), drawings[scene]])
            if place := address(config, variant, scene, block):
                yield f'<a href="../explorer.html#{place}">Open it in the explorer</a>'
            values = measured(root, config, variant, scene)
            rows = ((name, printed(scene, name), value) for name, value in values.items())
            yield from _table(("quantity", "the paper", "measured here"), rows)
    yield "\n## Corrections to the paper\n"
    verdicts = ledger.by_verdict(ledger.read_json(read_text(root / ledger.DATA)))
    for word in (FALSE, CORRECTED):
        numbers = [f"[{v.number}](../CLAIMS.md#statement-{v.number})" for v in verdicts[word]]
        yield f"- {word}: statements {', '.join(numbers)}"
    yield "\n## What made the results\n"
    yield "Seconds and commit are those of the run that made a file."
    records = {path: read_record(root, record_path(path)) for path in shown}
    yield from _table(("file", "sha256", "commit", "seconds"), map(_made, records.items()))
    versions = {each for record in records.values() for each in record["environment"].items()}
    yield f"Made with {', '.join(map(' '.join, sorted(versions)))}."


def _made(result: tuple[str, dict[str, Any]]) -> list[str]:
    """Return the cells of a result, given with its record."""
    path, record = result
    seconds, commit = record.get("seconds"), (record.get("commit") or "none")[:12]
    commit += ", with changes" * bool(record.get("dirty"))
    took = f"{seconds:.1f}" if isinstance(seconds, float) else "not known"
    return [f"`{path}`", f"`{record['output']['sha256'][:16]}`", commit, took]


def _gallery(root: Path, config: Config) -> Iterator[str]:
    """Yield the gallery: a card for each committed picture, with the YAML that makes it."""
    yield "---\nhide-toc: true\n---\n\n# Gallery"
    yield "\nA card leads to the picture's caption."
    yield "[Examples](../docs/examples/README.md) has pictures made by Python."
    for each in published_sets.committed_sets(config):
        yield f"\n## {SETS[each.group].heading}\n\n`{each.command}`\n\n:::::{{container}} cards"
        key = SETS[each.group].key
        for name in sorted(n for n in each.drawn if n.endswith(".png")):
            scene, picture = Path(name).stem, f"{each.folder}/{name}"
            if not (root / picture).is_file():
                continue
            block = config.variants[each.group][scene].as_mapping()
            caption = caption_of(scene if each.group == MAIN else f"{each.group}/{scene}", block)
            title = f"{caption.name}: {caption.title}"
            to = f"../docs/figures.md#{anchor(title)}"
            yield f"::::{{container}} card\n[![{title}](../{picture})]({to})\n\n{title}\n"
            if place := address(config, each.group, scene, block):
                yield f'<a href="../explorer.html#{place}">Open it in the explorer</a>\n'
            yield "<details><summary>YAML</summary>\n"
            yield f"```yaml\n{key}:\n{_lines(root, key, scene)}```\n\n</details>\n\n::::"
        yield ":::::"


def _lines(root: Path, key: str, scene: str) -> str:
    """Return the lines of a scene, from config.yaml or from the file of its part."""
    for file in (root / "config.yaml", *sorted(root.glob("src/**/scenes.yaml"))):
        text = re.search(rf"^{key}:.*\n((?:(?:[ #].*)?\n)+)", read_text(file), re.M)
        if text and (own := re.search(rf"^  {scene}:.*\n(?:(?:    .*)?\n)*", text[1], re.M)):
            return own[0].rstrip() + "\n"
    return f"  {scene}\n"


def _theorem(root: Path, config: Config, name: str) -> Iterator[str]:
    """Yield the page of a theorem: its statement, what was found, and its premises."""
    statement = typeset(THEOREMS[name].statement)
    premises = tomllib.loads(read_text(root / _PROOFS / "theorems" / "premises.toml"))
    yield f"# {premises['titles'][name]}\n\nTheorem `{name}`: {statement}.\n"
    path = next(
        p for (_, scene, stage), p in config.datasets.items() if (scene, stage) == (name, "theorem")
    )
    if Freshness(root, config.build_specs()).state(path) == CURRENT:
        found = load(root / path).attrs["line"].split("; ")
        yield f"**Checked by this run:** {'; '.join(found[1:])}.\n"
    known = premises["group"]
    groups = [g for g in known if name in g["theorems"] or g["title"] == "All"]
    proofs = {group["proof"] for group in groups[1:]}
    links = [f"[Proof: {p.removesuffix('.md')}](../{_PROOFS}/theory/{p})" for p in sorted(proofs)]
    certificate = f"{_PROOFS}/certificates/{THEOREMS[name].certificate}"
    yield " · ".join([*links, f"[Certificate](../{certificate})"])
    yield "\n## Premises\n\nThe checker decides each of them, or refuses the certificate."
    for group in groups:
        yield f"\n### {group['title']}"
        yield from _table(("premise", "checked by"), group["premises"])


def _api() -> Iterator[str]:
    """Yield the reference of the Python functions, from their docstrings."""
    yield "# Python functions\n\n```{eval-rst}\n.. automodule:: pseudorigid\n   :no-members:\n```"
    yield "\nFunctions of `extensions` are for a checkout, and are no part of the wheel."
    for module, names in ("pseudorigid", vars(pseudorigid)["__all__"]), *_OF_PARTS.items():
        for name in names:
            kind = "autoclass" if name[0].isupper() else "autofunction"
            yield f"\n## {name}\n\n```{{eval-rst}}\n.. {kind}:: {module}.{name}\n```"
