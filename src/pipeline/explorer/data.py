"""Data of the page: scenes of config.yaml, hashes of published orbits, the atlas."""

import json
import tomllib
from pathlib import Path
from typing import Any

from ..config.paths import PAPER, PUBLISHED
from ..config.schema.fields import YamlMapping
from ..records.files import read_text
from ..records.sources import ROOT
from . import atlas

CHECKED_FIGURES = ("fig2", "fig8")
STATE = ("x", "xdot", "udot", "tau")
_SCENES = (PAPER, "claims", "proofs")


def collect(checked: YamlMapping, root: Path = ROOT) -> dict[str, Any]:
    """Return the data, which JSON can hold; the same tree gives the same data."""
    return {
        "version": _version(root),
        "scenes": {
            name: block for group in _SCENES for name, block in checked["variants"][group].items()
        },
        "check": _published_orbits(root),
        "atlas": atlas.stored() | {"steps": atlas.STEPS, "missing": atlas.MISSING},
    }


def _version(root: Path) -> str:
    project = tomllib.loads(read_text(root / "pyproject.toml"))["project"]
    return f"{project['name']} {project['version']}"


def _published_orbits(root: Path) -> list[dict[str, Any]]:
    """Return the committed figures' starts, and the hashes of their orbits' variables.

    Hashes are those of MANIFEST.json: SHA-256 of all values of a variable as little-endian doubles,
    and the beginnings of the hashes of its blocks.
    """
    manifest = json.loads(read_text(root / PUBLISHED[PAPER] / "MANIFEST.json"))
    figures = []
    for figure in CHECKED_FIGURES:
        scene = manifest["scenes"][figure]
        block, variables = scene["config"], manifest["data"][scene["data"]["orbits"]]["variables"]
        figures.append(
            {
                "figure": figure,
                **block["ball"],
                **{name: block[name] for name in ("energy", "starts", "impacts")},
                "block": 1024,
                "variables": {
                    name: {part: variables[name][part] for part in ("sha256", "blocks")}
                    for name in STATE
                },
            }
        )
    return figures
