"""Tests that read the config of the repository pass with an edited one."""

import os
import re
import shutil
import subprocess

import pytest

from helpers.documents import SCENES
from helpers.project import ROOT, Tree, run, shipped

# What a test contains that reads it: the file, or a command that is run there.
READS_CONFIG = re.compile(
    r'ROOT / "config\.yaml"|text_of\("config|cwd=ROOT|helpers\.commands|figures_page\.page'
)
NOT_COPIED = shutil.ignore_patterns(".venv", "results", ".snakemake", "__pycache__", ".*_cache")


@pytest.fixture
def edited(tmp_path):
    """A copy with another energy, ball, scenes, and an edited and a new variant and sweep."""
    document = shipped()
    document["scenes"]["fig2"]["energy"] = 0.0095
    document["scenes"]["fig4"]["ball"] = {"k": 0.21, "g": 0.04}
    document["scenes"] |= {name: block | {"formats": ["png"]} for name, block in SCENES.items()}
    document["variants"]["lower-energy"]["energy"] = 0.0097
    document["variants"]["mine"] = {"energy": 0.0099}
    sweep = {"k": [0.2], "energy": [1, 2], "starts": 10, "impacts": 100, "block": 1}
    document["sweeps"]["plane"]["starts"] = 100
    document["sweeps"]["mine"] = sweep
    tree = Tree(shutil.copytree(ROOT, tmp_path / "copy", symlinks=True, ignore=NOT_COPIED))
    tree.write(document)
    tree.warm()
    return tree


@pytest.mark.slow
def test_the_suite_passes_with_an_edited_config(edited):
    assert {f"results/paper/figures/{name}.png" for name in SCENES} <= edited.planned()
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST_")}
    how = {"env": environment | {"PYTHONPATH": str(edited.path / "src")}}
    how["stdin"] = subprocess.DEVNULL
    tests = sorted((edited.path / "tests").rglob("test_*.py"))
    reading = [file for file in tests if READS_CONFIG.search(file.read_text())]
    assert len(reading) > 5
    result = run(*edited.command("test", "-q", *reading), **how)
    assert result.returncode == 0, result.stdout[-5000:]
    # Other tests read the config at most where they are imported.
    result = run(*edited.command("test", "-q", "--collect-only"), **how)
    assert result.returncode == 0, result.stdout[-5000:]
