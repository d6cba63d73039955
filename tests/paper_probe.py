"""Make every published figure in one process and print a JSON line of their hashes.

    python tests/paper_probe.py [scene ...]

Runs the scripts of the workflow without snakemake, whose jobs are processes of their own and would
leave an emulator. Results go to a temporary folder.
"""

import hashlib
import json
import os
import runpy
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

from pipeline import config
from pipeline.config import places
from pipeline.records import provenance

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = ROOT / "workflow" / "scripts"
INPUTS = {"motion": ["periodic"], "manifolds": ["periodic"]}  # of a stage
DATA = {  # of a picture, as the rules hand them to it
    "portrait": ["orbits"],
    "motion": ["motion"],
    "tangle": ["orbits", "manifolds", "periodic"],
    "closeup": ["manifolds"],
    "exponents": ["lyapunov"],
}


class Files(list):
    """A list of files, some with a name, as snakemake hands them to a script."""

    code = ()


def run(script, name, inputs, output, **params):
    """Run a script of the workflow for one scene."""
    given = Files(inputs)
    given.periodic = given.data = inputs
    made = Files([output])
    made.record = provenance.record_path(output)
    job = SimpleNamespace(
        rule=Path(script).stem,
        threads=1,
        wildcards={"scene": name},
        input=given,
        output=made,
        log=["log"],
        params=SimpleNamespace(**params),
    )
    runpy.run_path(str(SCRIPTS / script), init_globals={"snakemake": job})


def paper(names):
    """Yield (file name, hash) of the figures of these scenes, or of all."""
    scenes = config.load(SHIPPED)["scenes"]
    serves = places.served({"paper": scenes})
    for scene in names or scenes:
        block = scenes[scene]

        def data(stages, scene=scene):
            return [serves["paper", scene, stage] for stage in stages]

        for stage, parameters in places.stages(block).items():
            (output,) = data([stage])
            if not Path(output).exists():
                run(f"{stage}.py", scene, data(INPUTS.get(stage, [])), output, block=parameters)
        for extension in block["formats"]:
            if extension in places.SHOWN:
                output = places.drawn(scene, extension)
                drawing = places.drawing(block)
                run("draw.py", scene, data(DATA[block["picture"]]), output, scene=drawing)
                yield Path(output).name, hashlib.sha256(Path(output).read_bytes()).hexdigest()


if __name__ == "__main__":
    sys.path.insert(0, str(SCRIPTS))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        print(json.dumps(dict(paper(sys.argv[1:])), sort_keys=True))
        os.chdir(ROOT)
