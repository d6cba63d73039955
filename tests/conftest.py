"""Fixtures of the whole suite, and the compilation before it."""

import hashlib
import os
import pickle
import shutil
import subprocess
import sys
from contextlib import suppress
from datetime import date

import hypothesis
import pytest

from helpers.project import ROOT, Tree, fresh_tree, of_scenes, once
from helpers.runs import VARIANTS
from pipeline.declaration import parts
from pipeline.records import sources

# Its own profile for servers tries the same examples each day.
hypothesis.settings.register_profile("of the day", derandomize=False)
hypothesis.settings.load_profile("of the day")

# As under ./reproduce: tests that pytest has rewritten are kept, which halves collection.
sys.dont_write_bytecode = False


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config):
    """Use one worker per core and the seed of the day, unless an option says otherwise."""
    option = config.option
    if option.hypothesis_seed is None:
        option.hypothesis_seed = f"{date.today():%Y%m%d}"
    chosen = getattr(option, "numprocesses", 0) is not None or option.usepdb or option.collectonly
    if not (chosen or hasattr(config, "workerinput")):
        on_linux = hasattr(os, "sched_getaffinity")
        cores = len(os.sched_getaffinity(0)) if on_linux else os.cpu_count()
        option.numprocesses, option.dist = cores, "worksteal"


def pytest_report_header(config):
    """Say with which option property tests try the same examples on another day."""
    return f"property tests: --hypothesis-seed={config.option.hypothesis_seed}"


def pytest_configure(config):
    """Compile everything once for all workers; a single process compiles what it needs."""
    option = config.option
    alone = not getattr(option, "numprocesses", 0)
    if hasattr(config, "workerinput") or option.collectonly or alone:
        return
    # If this fails, a test says why, and each worker compiles what it needs.
    subprocess.run(
        [sys.executable, str(ROOT / "tests/helpers/compile_kernels.py")], check=False, cwd=ROOT
    )


@pytest.fixture(scope="session")
def shared(tmp_path_factory, request):
    """(name, make) -> a read-only folder that one process makes for all workers."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if hasattr(request.config, "workerinput") else base
    return lambda name, make: once(base / "shared" / name, make)


@pytest.fixture(scope="session")
def pickled(shared, request):
    """(name, compute, *modules) -> a value that one process computes for all workers.

    It is kept for later runs if `modules`, all that computes it, are given.
    """

    def read(name, compute, *modules):
        def make(folder):
            folder.mkdir()
            (folder / "pickle").write_bytes(pickle.dumps(compute()))

        if not modules:
            return pickle.loads((shared(name, make) / "pickle").read_bytes())
        files = [ROOT / file for file in sources.source_files(*modules)]
        files += (ROOT / "tests").rglob("claim_data.py")
        locked = (ROOT / "requirements" / "lock.txt").read_bytes()
        meaning = [sources.syntax_hash(file) for file in files], locked
        digest = hashlib.sha256(repr(meaning).encode()).hexdigest()[:16]
        kept = request.config.cache.mkdir("computed") / f"{name}-{digest}"
        return pickle.loads((once(kept, make) / "pickle").read_bytes())

    return read


@pytest.fixture
def tree(tmp_path):
    """The files of a fresh clone: sources, and figures that are newer than anything."""
    return fresh_tree(tmp_path / "a fresh clone")


def _finish(folder):
    (folder / "first run").write_text(fresh_tree(folder).succeed())


@pytest.fixture(scope="session")
def finished(shared):
    """A read-only copy of a fresh clone in which every figure was made."""
    return Tree(shared("a folder with spaces", _finish))


@pytest.fixture
def done(finished, tmp_path):
    """A copy of `finished` that one test may change."""
    return finished.copy(tmp_path / "done")


@pytest.fixture(scope="session")
def accepted(shared, finished):
    """A read-only copy of `finished` whose small figures were accepted."""
    return Tree(shared("accepted here", lambda folder: finished.copy(folder).succeed("accept")))


@pytest.fixture(scope="session")
def variants(shared, finished):
    """A read-only copy with three small scenes and two variants, one of them compared."""

    def compare(folder):
        tree = fresh_tree(folder, of_scenes("fig3", "fig4", "fig7", variants=VARIANTS), finished)
        tree.make_here("results/low/figures/fig3.png", "results/low/figures/fig7.png")
        with suppress(ValueError):  # which is recorded: there is no such orbit
            tree.make_here("results/low/motion_fig4.nc")
        if "publication" in parts():
            (folder / "said of paper and low").write_text(tree.succeed("compare", "paper", "low"))
        else:
            tree.succeed()
            tree.succeed("variant", "low")

    return Tree(shared("variants in a folder with spaces", compare))


# File of pseudorigid/dynamics -> code appended to it: other data, the same data, and a bug.
EDITS = {
    "motion.py": """_MOTION = scene_motion


def scene_motion(*given, **fields):
    found = _MOTION(*given, **fields)
    return found.assign(strain=found["strain"] * 1.01)
""",
    "orbits.py": "_EDITED = 1\n",
    "manifolds.py": "\n\ndef scene_manifolds(*_, **__):\n    return 1 / 0\n",
}


@pytest.fixture(scope="session")
def edited(shared, accepted):
    """A read-only fresh clone with results from a cache and with edits, in which a run was made.

    EDITS are those of the stages of figures 3 and 4, of 2 and 8, and of 5 and 6. Figure 8 lacks its
    drawing, and figure 7 has another config. One scene is new, one cannot exist, and a published
    figure has no scene. The files `plan` and `output` hold what `-n` and the run printed.
    """

    def make(path):
        tree = fresh_tree(path, results_of=accepted)
        figures = path / "paper_figures"
        shutil.copytree(
            accepted.path / "paper_figures", figures, copy_function=shutil.copy, dirs_exist_ok=True
        )
        shutil.copy(figures / "fig3.png", figures / "fig9.png")
        (path / "results/paper/figures/fig8.png").unlink()
        tree.edit("fig7", records=5)
        document = tree.document()
        scenes = document["scenes"]
        scenes["again"] = scenes["fig7"] | {"impacts": 40, "formats": ["png"]}
        scenes["absent"] = scenes["fig3"] | {"type": "inverse hyperbolic", "formats": ["png"]}
        tree.write(document)
        for file, text in EDITS.items():
            tree.append(f"pseudorigid/dynamics/{file}", text)
        for i, file in enumerate(sorted(path.glob("src/**/*.py"))):
            os.utime(file, (4e9, 4e9) if i % 2 else (0, 0))
        (path / "plan").write_text(tree.run("-n").stdout)
        result = tree.run()
        assert result.returncode == 1  # figures are missing
        (path / "output").write_text(result.stdout)

    return Tree(shared("with edits", make))


@pytest.fixture
def moved(accepted, tmp_path, monkeypatch):
    """A copy of `accepted` in another folder, for one fault."""
    tree = accepted.copy(tmp_path / "moved")
    tree.is_here(monkeypatch)
    return tree
