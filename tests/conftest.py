"""Fixtures for the whole suite, and what is done once before it."""

import os
import pickle
import subprocess
import sys

import pytest
from project import ROOT, Tree, fresh_tree, of_scenes, once
from runs import VARIANTS

from pipeline.records import sources


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config):
    """A worker for each core, where nothing else is asked for (-n0, -p no:xdist)."""
    option = config.option
    asked = getattr(option, "numprocesses", 0) is not None or option.usepdb or option.collectonly
    if not (asked or hasattr(config, "workerinput")):
        option.numprocesses, option.dist = len(os.sched_getaffinity(0)), "worksteal"


def pytest_configure(config):
    """Compile everything once, before workers would each do it for themselves."""
    if hasattr(config, "workerinput") or config.option.collectonly:
        return
    # Where that fails, a test will tell why; each worker then compiles what it needs.
    subprocess.run([sys.executable, str(ROOT / "tests" / "warm.py")], check=False, cwd=ROOT)


@pytest.fixture(scope="session")
def shared(tmp_path_factory, request):
    """name, make -> a folder that one process made, for all of them; to be left as it is."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if hasattr(request.config, "workerinput") else base
    return lambda name, make: once(base / "shared" / name, make)


@pytest.fixture(scope="session")
def pickled(shared):
    """name, compute -> what one process computed, for all of them."""

    def read(name, compute):
        def make(folder):
            folder.mkdir()
            (folder / "pickle").write_bytes(pickle.dumps(compute()))

        return pickle.loads((shared(name, make) / "pickle").read_bytes())

    return read


@pytest.fixture(scope="session")
def derived(pickled):
    """The dataset of all derivations, which take seconds."""
    from claim_data import made

    from pseudorigid.proofs.derivations import derivations

    return pickled("derivations", lambda: made(derivations))


@pytest.fixture
def tree(tmp_path):
    """A fresh clone, as far as files go: sources, and figures newer than anything."""
    return fresh_tree(tmp_path / "a fresh clone")


def _finish(folder):
    tree = fresh_tree(folder)
    result = tree.run()
    (folder / "first run").write_text(result.stdout)
    assert result.returncode == 0, result.stdout


def _accept(folder, finished):
    tree = Tree(finished).copy(folder)
    result = tree.run("accept")
    assert result.returncode == 0, result.stdout


@pytest.fixture(scope="session")
def finished(shared):
    """A copy in which everything was made, from the state of a fresh clone; to be left as it is."""
    return Tree(shared("a folder with spaces", _finish))


@pytest.fixture
def done(finished, tmp_path):
    """A copy of the finished one, for one test."""
    return finished.copy(tmp_path / "done")


@pytest.fixture(scope="session")
def accepted(shared, finished):
    """A finished copy whose small figures were accepted; not to be changed."""
    return Tree(shared("accepted here", lambda folder: _accept(folder, finished.path)))


def _compare_variants(folder):
    tree = fresh_tree(folder, of_scenes("fig3", "fig4", "fig7", variants=VARIANTS))
    result = tree.run("compare", "paper", "low")
    assert result.returncode == 0, result.stdout
    (folder / "said of paper and low").write_text(result.stdout)
    result = tree.run("variant", "doubled")
    assert result.returncode == 0, result.stdout


@pytest.fixture(scope="session")
def variants(shared):
    """Three small scenes and variants that were made, two of them compared; to be left as it is."""
    return Tree(shared("variants in a folder with spaces", _compare_variants))


@pytest.fixture
def moved(accepted, tmp_path, monkeypatch):
    """A fresh copy of that folder in another place, for one fault."""
    tree = accepted.copy(tmp_path / "moved")
    monkeypatch.setattr(sources, "ROOT", tree.path)
    monkeypatch.setattr(sources, "SRC", tree.path / "src")
    return tree
