"""The test files in which a pattern finds that they read config.yaml pass with an edited one."""

import os
import re
import shutil
import subprocess

import pytest
from documents import SCENES
from project import ROOT, Tree, run, shipped

from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.scene import Scene

# What a test contains that reads the config of the repository: the file's name, or a command there.
READS_CONFIG = re.compile(r'"config\.yaml"|cwd=ROOT|from commands import|figures_page|\bmain\(\[')


def edited(document):
    """Another energy and ball, a scene of each kind, a variant and a sweep, edited and new."""
    scenes = document["scenes"]
    scenes["fig2"]["energy"] = 0.0095
    scenes["fig4"]["ball"] = {"k": 0.21, "g": 0.04}
    scenes |= {name: block | {"formats": ["png"]} for name, block in SCENES.items()}
    for part in ("claims", "families", "proofs"):
        scenes |= {f"my_{name}": block for name, block in document[part].items()}
    scenes["my_twist"]["energies"] = [0.001, 0.01, 0.03]  # which every variant's ball can have
    scenes["my_energy"]["span"] = [-0.001, 0.02]
    of_a_ball = {name for name, kind in KINDS.items() if issubclass(kind, Scene) and kind.headline}
    assert {block["picture"] for block in scenes.values()} == of_a_ball
    document["variants"]["lower-energy"]["energy"] = 0.0097
    document["variants"]["mine"] = {"energy": 0.0099}
    sweep = {"k": [0.2], "energy": [1, 2], "starts": 10, "impacts": 100, "block": 1}
    document["sweeps"]["plane"]["starts"] = 100
    document["sweeps"]["mine"] = sweep
    return document


@pytest.fixture
def clone(tmp_path):
    """A clone of the last commit, with the files as they are now and an edited config."""
    path = tmp_path / "clone"
    if run("git", "clone", "-q", ROOT, path).returncode:
        pytest.skip("no git repository here: there is nothing to clone")
    files = run("git", "-C", ROOT, "ls-files", "-z", "-co", "--exclude-standard").stdout
    for name in filter(None, files.split("\0")):
        if (ROOT / name).is_file():
            (path / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, path / name)
        else:  # deleted since the commit
            (path / name).unlink(missing_ok=True)
    tree = Tree(path)
    tree.write(edited(shipped()))
    tree.warm()
    return tree


@pytest.mark.slow
def test_the_suite_passes_with_an_edited_config(clone):
    planned = clone.planned()
    assert {f"results/paper/figures/{name}.png" for name in (*SCENES, "my_flux")} <= planned
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST_")}
    environment |= {"PYTHONPATH": str(clone.path / "src")}
    tests = sorted((clone.path / "tests").rglob("test_*.py"))
    reading = [file for file in tests if READS_CONFIG.search(file.read_text())]
    assert len(reading) > 15
    how = {"env": environment, "stdin": subprocess.DEVNULL}
    result = run(*clone.command("test", "-q", *reading), **how)
    assert result.returncode == 0, result.stdout[-5000:]
    assert re.search(r"\d{3,} passed", result.stdout.splitlines()[-1])
    # The paper's figures were compared all the same.
    assert "figures are not compared" not in result.stdout
    # Other tests read the config at most where they are imported.
    result = run(*clone.command("test", "-q", "--collect-only"), **how)
    assert result.returncode == 0, result.stdout[-5000:]
