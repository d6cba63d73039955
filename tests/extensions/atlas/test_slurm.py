"""Sweeps on a real Slurm of two nodes: ./reproduce test -m slurm, as root on Debian."""

import hashlib
import subprocess

import pytest

from helpers.parts import slurm_node
from helpers.project import fresh_tree

pytestmark = pytest.mark.slurm

SWEEP = {"k": [0.1, 0.2], "energy": [0.625, 2, 6.25], "starts": 40, "impacts": 30_000, "block": 1}
QUICK = ("--slurm-init-seconds-before-status-checks", "1", "--seconds-between-status-checks", "1")


@pytest.fixture(scope="module")
def cluster():
    pytest.importorskip("snakemake_executor_plugin_slurm")
    if reason := slurm_node.missing():
        pytest.skip(reason)
    with slurm_node.Cluster() as running:
        yield running


@pytest.fixture(scope="module")
def local(tmp_path_factory):
    """Hashes of the datasets that a run without Slurm makes."""
    tree = small_tree(tmp_path_factory.mktemp("local"))
    result = tree.run("sweep", "--cores", "1")
    assert result.returncode == 0, result.stdout
    made = hashes(tree)
    assert len(made) == 1 + len(SWEEP["k"]) * len(SWEEP["energy"])
    return made


def small_tree(folder):
    tree = fresh_tree(folder / "a fresh clone")
    tree.write(tree.document() | {"sweeps": {"small": SWEEP}})
    return tree


def hashes(tree):
    files = sorted((tree.path / "results" / "atlas").rglob("*.nc"))
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def begin(tree, cluster):
    """Start the sweep on Slurm, with the tree's own code in ./reproduce and in the jobs."""
    profile = tree.path / "profiles" / "slurm"
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    environment = tree.environment() | cluster.environment
    return tree.start("sweep", "--", "--profile", str(profile), *QUICK, env=environment, **output)


def finish(process, seconds=300):
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        output, _ = process.communicate()
        pytest.fail(f"not done after {seconds} s:\n{output}")
    return process.returncode, output


def test_a_sweep_on_slurm_gives_the_same_bytes(cluster, local, tmp_path):
    tree = small_tree(tmp_path)
    status, output = finish(begin(tree, cluster))
    assert status == 0, output
    assert hashes(tree) == local
    done = cluster.jobs("CD")
    assert len(done) >= len(SWEEP["k"]) * len(SWEEP["energy"])
    assert set(done.values()) == set(slurm_node.NODES)
