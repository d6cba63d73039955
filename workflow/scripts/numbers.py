"""The tables of the report: numbers of the paper beside ours, and what made each result."""

import json
from pathlib import Path

from job import one_line_errors
from pipeline.checks import report
from pipeline.records.artifacts import load
from pipeline.records.files import replacing

with one_line_errors(snakemake):
    paths = snakemake.params.artifacts
    rows = report.numbers(snakemake.params.scenes, lambda scene, stage: load(paths[scene][stage]))
    labels = {
        scene: report.label(scene, block["picture"], rows[scene])
        for scene, block in snakemake.params.scenes.items()
    }
    made, packages = report.provenance(Path(), snakemake.params.results)
    texts = {
        snakemake.output.labels: json.dumps(labels),
        snakemake.output.numbers: report.page(
            "Numbers",
            ("figure", "quantity", "the paper", "here"),
            [(scene, *row) for scene in rows for row in rows[scene]],
        ),
        snakemake.output.provenance: report.page(
            "Provenance",
            ("file", "sha256", "commit"),
            made,
            [
                f"{len(files)} of these files made with {names}."
                for names, files in packages.items()
            ],
        ),
    }
    # snakemake reads captions when it makes the report, each with its own scene as `s`
    head = "{% set s = snakemake.params.block %}\n"
    texts |= {path: head + text for path, text in snakemake.params.captions.items()}
    for path, text in texts.items():
        with replacing(path) as part:
            part.write_text(text, encoding="utf-8")
