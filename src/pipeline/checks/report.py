"""What the report shows beside the figures: the paper's numbers and ours, and provenance."""

import html
import json

from ..config import KINDS, stages
from ..records.record import record_path

# What the paper prints, in its text and captions: scene -> quantity -> value.
PRINTED = {
    "fig2": {"orbits": "8", "impacts": "approximately 45,000"},
    "fig3": {"orbit": "elliptic, period one", "time": "0 to 16"},
    "fig4": {"orbit": "elliptic, period six", "time": "0 to 60"},
    "fig5": {"orbit": "hyperbolic, period six"},
    "fig6": {
        "orbit": "hyperbolic, period six",
        "x of the point": "between 0.21 and 0.2116",
        "xdot of the point": "between 0.0925 and 0.0932",
    },
    "fig7": {"largest exponent": "approximately 0.235"},
    "fig8": {"orbits": "6", "impacts": "approximately 35,000"},
}
PARAMETERS = {f"fig{n}": "0.2, 0.04, 0.01" for n in range(2, 8)} | {"fig8": "0.2, 0.04, 0.001"}
NOT_PRINTED = "not printed"


def numbers(scenes, load):
    """Scene -> rows (quantity, the paper's value, ours); `load(scene, stage)` reads an artifact."""
    found = {}
    for scene, block in scenes.items():
        data = {stage: load(scene, stage) for stage in stages(block)}
        ours = {
            "k, g, energy": ", ".join(
                map(str, (block["ball"]["k"], block["ball"]["g"], block["energy"]))
            )
        }
        ours |= KINDS[block["picture"]].numbers(block, **data)
        printed = {"k, g, energy": PARAMETERS[scene]} if scene in PARAMETERS else {}
        printed |= PRINTED.get(scene, {})
        found[scene] = [(key, printed.get(key, NOT_PRINTED), ours[key]) for key in ours]
    return found


def label(scene, picture, rows):
    """A figure's line in the list: its most telling number here and in the paper."""
    quantity = KINDS[picture].telling
    paper, ours = {key: values for key, *values in rows}[quantity]
    return f"{scene}: {quantity} {ours} (the paper: {paper})"


def provenance(root, paths):
    """(rows (file, sha256, commit), {packages: files}) from the records of results."""
    rows, packages = [], {}
    for path in paths:
        record = json.loads((root / record_path(path)).read_text(encoding="utf-8"))
        commit = record["commit"][:12] if record["commit"] else "no commit"
        changed = ", with changes" if record["dirty"] else ""
        rows.append((path, record["output"]["sha256"], commit + changed))
        versions = ", ".join(f"{name} {version}" for name, version in record["environment"].items())
        packages.setdefault(versions, []).append(path)
    return rows, packages


def page(title, head, rows, notes=()):
    """A table as an HTML page of its own, with `notes` below it."""

    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    style = (
        "body{font:15px sans-serif;margin:1.5em;color:#222;background:#fff}"
        "table{border-collapse:collapse}td,th{padding:.3em .8em;text-align:left;"
        "border-bottom:1px solid #ddd;vertical-align:top}"
        "td{overflow-wrap:anywhere}td:first-child{white-space:nowrap}p{max-width:60em}"
    )
    body = "\n".join([line(head, "th"), *(line(row, "td") for row in rows)])
    below = "".join(f"<p>{html.escape(note)}</p>" for note in notes)
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f"<style>{style}</style></head><body><h1>{title}</h1>\n<table>\n{body}\n</table>"
        f"{below}</body></html>\n"
    )
