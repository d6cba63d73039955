"""Data of the page: scenes of config.yaml, hashes of published orbits, the atlas.

The atlas is a small map of the share of regular motion over k and E/g^2. It is committed, because
the sweep behind it takes minutes. Renew it after ./reproduce atlas:

    .venv/bin/python -m extensions.explorer.data
"""

import base64
import json
from pathlib import Path
from typing import Any
from urllib.parse import quote

import yaml

import pseudorigid
from pipeline.checks.captions import caption_of
from pipeline.config import MAIN, PUBLISHED, Config
from pipeline.config.schema.fields import YamlMapping
from pipeline.config.schema.kinds import KINDS
from pipeline.declaration import files
from pipeline.records.files import read_text, write_whole
from pipeline.records.sources import ROOT

STATE = ("x", "xdot", "udot", "tau")
ATLAS = "explorer_map.json"  # a file of the part that has the sweeps
# The shares of the atlas, from 0 to 1, are rounded in these steps; MISSING means no value.
STEPS, MISSING = 250, 255


def collect(checked: Config, root: Path = ROOT) -> dict[str, Any]:
    """Return the data, which JSON can hold; the same tree gives the same data."""
    return {
        "version": f"pseudorigid {pseudorigid.__version__}",
        "citation": citation(),
        "scenes": {
            name: {
                field: value for field, value in block.as_mapping().items() if field != "formats"
            }
            for variant, scenes in checked.variants.items()
            for scene, block in scenes.items()
            if (name := address(checked, variant, scene, block.as_mapping()))
        },
        "presets": presets(checked),
        **{
            name: json.loads(read_text(Path(__file__).with_name("web") / f"{name}.json"))
            for name in ("tour", "lesson")
        },
        "check": published_orbits(root),
        "atlas": stored_atlas(),
    }


def of_parts(name: str) -> list[Path]:
    """Return the files of a name beside part.py, those of parts that are no extension first."""
    return sorted(files(name).values(), key=lambda file: (len(file.parts), file))


def presets(checked: Config) -> list[dict[str, str]]:
    """Return titles of scenes and what to see in them, from the captions.

    A title names what the page shows of the picture, and no name of config.yaml.
    """
    found = []
    for variant in PUBLISHED:
        for scene, block in checked.variants[variant].items():
            mapping = block.as_mapping()
            if address(checked, variant, scene, mapping) == scene:
                caption = caption_of(scene, mapping)
                shown = caption.explorer_title or caption.title
                numbered = caption.name.startswith("Figure ")
                title = f"{caption.name}: {shown}" if numbered else shown[0].upper() + shown[1:]
                see = caption.explorer or caption.see
                found.append({"name": scene, "title": title, "see": see})
    return found


def citation() -> dict[str, Any]:
    """Return how to cite the software and the paper, and links, from CITATION.cff.

    The page is copied to places without the tree: a link leads to an address that CITATION.cff
    has, and that file is in the page itself.
    """
    text = read_text(ROOT / "CITATION.cff")
    facts = yaml.safe_load(text)
    (paper,) = (each for each in facts["references"] if each["type"] == "article")
    people = [f"{one['given-names']} {one['family-names']}" for one in paper["authors"]]
    names = ", ".join(one["name"] for one in facts["authors"] if "name" in one)
    return {
        "software": f"{names}: {facts['title']}, version {facts['version']}.",
        "paper": f"{' and '.join(people)}: {paper['title']}. {paper['journal']}.",
        "links": {
            **({"paper": f"https://doi.org/{paper['doi']}"} if "doi" in paper else {}),
            **({"source": facts["repository-code"]} if "repository-code" in facts else {}),
            "citation": f"data:text/plain;charset=utf-8,{quote(text)}",
        },
    }


def address(checked: Config, variant: str, scene: str, block: YamlMapping) -> str | None:
    """Return what opens a scene of a variant in the page after `#`, None if nothing does.

    The first published set with a scene of a name has the bare name. Scenes with another method
    than the page's have other orbits.
    """
    if not KINDS[block["picture"]].on_section or "method" in block:
        return None
    sets = [name for name in PUBLISHED if scene in checked.variants[name]]
    return scene if [variant] == sets[:1] else f"{variant}/{scene}"


def published_orbits(root: Path = ROOT) -> list[dict[str, Any]]:
    """Return the committed figures' starts, and the hashes of their orbits' variables.

    Hashes are those of MANIFEST.json: SHA-256 of all values of a variable as little-endian doubles.
    """
    name = f"{PUBLISHED[MAIN]}/MANIFEST.json"
    if not (root / name).is_file():  # before the first ./reproduce accept
        return []
    orbits = []
    try:
        manifest = json.loads(read_text(root / name))
        for path, record in manifest["results"].items():
            block = record["config"]
            if block.get("picture") != "portrait" or not path.endswith(".png"):
                continue
            (data,) = record["inputs"]
            starts, counts = block["starts"], block["impacts"]
            if not all(isinstance(start, float) for start in starts):
                continue
            variables = manifest["results"][data]["output"]["variables"]
            orbits.append(
                {
                    "figure": Path(path).stem,
                    **block["ball"],
                    "energy": block["energy"],
                    "starts": starts,
                    "impacts": counts if isinstance(counts, list) else [counts] * len(starts),
                    "variables": {name: variables[name]["sha256"] for name in STATE},
                }
            )
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise ValueError(f"{name}: broken: {error!r}: run ./reproduce accept") from None
    return orbits


def stored_atlas() -> dict[str, Any] | None:
    """Return the map of the atlas that its part ships, or None without this part."""
    stored = [json.loads(read_text(file)) for file in of_parts(ATLAS)]
    return stored[0] | {"steps": STEPS, "missing": MISSING} if stored else None


def rounded_atlas(root: Path = ROOT) -> dict[str, Any]:
    """Return the atlas of the sweep that the tree at `root` has.

    `k` and `energy`, in g^2, are the values of the grid, and `regular` the shares in STEPS as bytes
    in base64, row by row of k.
    """
    import numpy as np

    from pipeline.records.artifacts import load  # takes long to import

    sweep = load(root / "results/atlas/sweep_plane.nc")
    share = sweep["regular"].transpose("k", "energy").values
    steps = np.where(np.isnan(share), MISSING, np.rint(STEPS * np.nan_to_num(share)))
    return {
        "k": sweep["k"].values.tolist(),
        "energy": sweep["energy"].values.tolist(),
        "regular": base64.b64encode(steps.astype(np.uint8).tobytes()).decode(),
    }


if __name__ == "__main__":
    write_whole(of_parts(ATLAS)[0], json.dumps(rounded_atlas(), separators=(",", ":")) + "\n")
