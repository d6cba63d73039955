"""Which figures of a variant cannot exist, for want of a periodic orbit; old ones are removed."""

import json
from pathlib import Path

from job import one_line_errors
from pipeline.records.artifacts import load
from pipeline.records.files import replacing
from pseudorigid.dynamics.variables import of_type


def reason(path, kind):
    """Why there is no orbit of this type in an artifact of stage periodic, or None."""
    orbits = load(path)  # a damaged one is an error, no reason
    try:
        of_type(orbits, kind)
    except ValueError as error:
        return str(error)
    return None


with one_line_errors(snakemake):
    wanted = snakemake.params.orbits
    paths = dict(zip(wanted, snakemake.input.periodic, strict=True))
    reasons = {scene: reason(paths[scene], kind) for scene, kind in wanted.items()}
    absent = {scene: why for scene, why in reasons.items() if why}
    folder = Path(snakemake.output[0]).parent
    for scene in absent:
        for old in (*folder.glob(f"figures/{scene}.*"), *folder.glob(f"provenance/{scene}.*")):
            old.unlink()
    with replacing(snakemake.output[0]) as part:
        part.write_text(json.dumps(absent, indent=1) + "\n", encoding="utf-8")
