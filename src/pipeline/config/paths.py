"""Stages of each scene, and paths of data and figures relative to the project's root."""

import json
import os
from pathlib import Path, PurePath

from pseudorigid import proofs
from pseudorigid.sweep import grid

from ..records.sources import ROOT
from .schema.fields import YamlMapping
from .schema.kinds import KINDS
from .schema.published import FOLDERS, PAPER, PUBLISHED
from .schema.stages import STAGES, upstream

__all__ = ["ARTICLE", "ATLAS", "DERIVATIONS", "EXPLORER", "LEDGER", "PAPER", "PUBLISHED", "SHOWN"]

SHOWN = ("png", "svg")  # formats that are published; pdf stays in results
ATLAS = FOLDERS["sweep"]
LEDGER = "CLAIMS.md"  # the verdicts on the paper's statements
LEDGER_DATA = "CLAIMS.json"  # the data from which CLAIMS.md is rendered
EXPLORER = "results/explorer.html"
ARTICLE = "results/article.pdf"
SITE = "results/site"
DERIVATIONS = "results/claims/derivations.nc"
CERTIFICATES = os.path.relpath(Path(*proofs.__path__) / "certificates", ROOT)
THEOREMS = sorted(file.stem for file in (ROOT / CERTIFICATES).iterdir())
# Functions of a name that return a path.
theorem = "results/claims/theorem_{}.nc".format  # the verdict on a theorem
sweep_dataset = "results/sweep/{}.nc".format
chains_dataset = "results/sweep/{}_chains.nc".format  # curves of chains over a sweep's plane
chains_picture = "results/sweep/figures/{}_chains.png".format

Variants = dict[str, dict[str, YamlMapping]]  # variant -> scene -> complete block


def stages(block: YamlMapping) -> dict[str, YamlMapping]:
    """Map each stage of a scene to the part of the scene's complete block that decides its data."""
    parameters = {}
    for name in upstream(KINDS[block["picture"]].stages):
        stage = STAGES[name]
        method = ("method",) if stage.takes(block.get("method", {})) else ()
        fields = ("ball", "energy", *stage.fields, *method)
        parameters[name] = {field: block[field] for field in fields if field in block}
    return parameters


def drawing(block: YamlMapping) -> YamlMapping:
    """Return the part of a scene's block that decides its drawing."""
    return {key: value for key, value in block.items() if key != "formats"}


def artifact_paths(variants: Variants) -> dict[tuple[str, str, str], str]:
    """Map (variant, scene, stage) to the path of the stage's dataset.

    A variant shares a scene's dataset with the first variant that gives this scene the same
    parameters and inputs. Scenes of other names never share, so that an added scene changes no
    path.
    """
    first_paths: dict[tuple[str, str, str], str] = {}
    dataset_paths: dict[tuple[str, str, str], str] = {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            for stage, parameters in stages(block).items():
                used = [dataset_paths[variant, scene, name] for name in STAGES[stage].inputs]
                key = scene, stage, json.dumps([parameters, used], sort_keys=True)
                path = first_paths.setdefault(key, f"results/{variant}/{stage}_{scene}.nc")
                dataset_paths[variant, scene, stage] = path
    return dataset_paths


def drawn(scene: str, extension: str, variant: str = PAPER) -> str:
    """Return the path where a figure is drawn, before it is published."""
    return f"results/{variant}/figures/{scene}.{extension}"


def figures(variants: Variants, variant: str = PAPER) -> dict[str, tuple[str, list[str]]]:
    """Map each figure, where users find it, to its scene, and to its data and last its drawing."""
    dataset_paths = artifact_paths(variants)
    figure_paths = {}
    for name, block in variants[variant].items():
        data = [dataset_paths[variant, name, stage] for stage in stages(block)]
        for extension in block["formats"]:
            drawing_path = drawn(name, extension, variant)
            published = variant in PUBLISHED and extension in SHOWN
            path = f"{PUBLISHED[variant]}/{name}.{extension}" if published else drawing_path
            figure_paths[path] = name, [*data, drawing_path]
    return figure_paths


def block_files(name: str, sweep: YamlMapping) -> list[str]:
    """Return the paths of a sweep's blocks, in the order of their cells."""
    return [f"results/sweep/{name}_{i:04d}.nc" for i in range(len(grid.ranges(sweep)))]


def sweep_pictures(name: str, sweep: YamlMapping) -> list[str]:
    """Return the paths where a sweep is drawn, last its chains, if it has the field.

    A plane has too many cells for vector graphics.
    """
    formats = SHOWN if len(sweep["k"]) == 1 else SHOWN[:1]
    pictures = [f"results/sweep/figures/{name}.{extension}" for extension in formats]
    return [*pictures, chains_picture(name)] if "chains" in sweep else pictures


def atlas_published(drawing_path: str) -> str:
    """Return the published path of a sweep's drawing."""
    return f"{ATLAS}/{PurePath(drawing_path).name}"
