"""Copies of the project, run as a user runs them."""

import fcntl
import os
import shutil
import subprocess
import sys
import time
from contextlib import chdir, contextmanager, nullcontext, suppress
from importlib import import_module
from pathlib import Path

import yaml

from helpers.programs import run
from paper.values import FIGURES
from pipeline.config import MAIN
from pipeline.config.schema.parts import SETS
from pipeline.records import sources
from pipeline.records.files import write_whole
from pipeline.records.provenance import git
from pseudorigid.kernel import compiled

ROOT = Path(__file__).parents[2]
PARTS = (
    *("CITATION.cff", "Snakefile", "profiles", "pyproject.toml", "reproduce", "requirements"),
    *("src", "workflow"),
)
# The C library parses and writes a config ten times as fast.
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_DUMPER = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
MEANINGS = "src/pipeline/records/__pycache__"  # where hashes of sources are kept
# Keys of config.yaml whose blocks are shipped.
APART = [each.key for name, each in SETS.items() if each.key and name != MAIN]
NO_CACHES = shutil.ignore_patterns("__pycache__", "*.egg-info")


def _shipped_config():
    """Return config.yaml as committed or staged; without a repository, the file that is there."""
    file = ROOT / "config.yaml"
    staged = git("show", ":./config.yaml", root=ROOT)
    if staged is None or staged == file.read_bytes():
        return file
    kept = ROOT / ".venv" / "cache" / "committed" / "config.yaml"
    kept.parent.mkdir(parents=True, exist_ok=True)
    write_whole(kept, staged)
    return kept


# The scenes as committed: tests look at these, never at the config.yaml of whoever runs them.
SHIPPED = _shipped_config()


def shipped():
    """A new document with the scenes of the paper as committed, and the shipped blocks beside them.

    Scenes that were added to config.yaml are left out, so that tests can count and name these.
    """
    from pipeline.config.validation.document import with_shipped

    document = with_shipped(yaml.load(SHIPPED.read_text(encoding="utf-8"), _LOADER))
    scenes = document["scenes"].items()
    return document | {"scenes": {name: block for name, block in scenes if name in FIGURES}}


def path_of_bare_python(folder):
    """Return a PATH whose python3, written to a folder, has the standard library alone (-S)."""
    folder.mkdir(exist_ok=True)
    python = folder / "python3"
    python.write_text(f'#!/bin/sh\nexec "{sys.base_prefix}/bin/python3" -S "$@"\n')
    python.chmod(0o755)
    return f"{folder}:/usr/bin:/bin"


def check_jsonschema(*arguments):
    """Return the exit status of check-jsonschema, called in this process, and what it prints."""
    import pytest  # an emulated processor imports this module without these packages
    from click.testing import CliRunner

    result = CliRunner().invoke(
        pytest.importorskip("check_jsonschema").main, [*map(str, arguments)]
    )
    return result.exit_code, result.output


class Tree:
    """A copy of the project at `path`, sharing the running interpreter.

    A `cold` one gets its machine code before its first process starts.
    """

    def __init__(self, path, cold=False):
        self.path, self.cold = path, cold

    @property
    def config(self):
        return self.path / "config.yaml"

    def document(self):
        """Parse its config."""
        return yaml.load(self.config.read_text(encoding="utf-8"), _LOADER)

    def write(self, document):
        """Replace its config."""
        text = yaml.dump(document, Dumper=_DUMPER, sort_keys=False)
        self.config.write_text(text, encoding="utf-8")

    def edit(self, scene, **fields):
        """Change fields of a scene in its config; None removes a field."""
        document = self.document()
        block = document["scenes"][scene] | fields
        document["scenes"][scene] = {k: v for k, v in block.items() if v is not None}
        self.write(document)

    def warm(self):
        """Copy the machine code of modules that mean the same, and the hashes of meanings."""
        self.cold = False
        here, there = Path(compiled.folders()[0]), self.path / "src/pseudorigid/kernel/__pycache__"
        there.mkdir(exist_ok=True)
        for kept in (ROOT / MEANINGS).glob("meanings-*.json"):
            (self.path / MEANINGS).mkdir(exist_ok=True)
            shutil.copy(kept, self.path / MEANINGS)
        for kept in here.glob("*.*-*"):
            module, _, digest = kept.name.rpartition("-")
            with suppress(ValueError):  # the module no longer exists
                if sources.machine_code_digest.__wrapped__(self.path / "src", module)[0] == digest:
                    shutil.copytree(kept, there / kept.name, dirs_exist_ok=True)

    def command(self, *arguments):
        """The command that ./reproduce runs when .venv is ready."""
        return [sys.executable, "-P", "-m", "pipeline", *arguments]

    def environment(self):
        """The environment in which ./reproduce runs its command."""
        if self.cold:
            self.warm()
        # ./reproduce lets Python write bytecode, which halves the time of each start.
        others = os.environ.keys() - {"PYTHONDONTWRITEBYTECODE", "COLUMNS"}
        kept = {name: os.environ[name] for name in others}
        return kept | {"PYTHONPATH": str(self.path / "src"), "PYTHONUTF8": "1"}

    def run(self, *arguments, **environment):
        """Run a command; stdout of the result holds all that a user sees."""
        output = {"capture_output": False, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        how = {"env": self.environment() | environment, "stdin": subprocess.DEVNULL, "cwd": "/"}
        return run(*self.command(*arguments), **how, **output)

    def succeed(self, *arguments):
        """Run a command that must succeed, and return what it prints."""
        result = self.run(*arguments)
        assert result.returncode == 0, result.stdout
        return result.stdout

    def python(self, *arguments, **environment):
        """Run Python with the code of this tree, in its folder."""
        environment = self.environment() | environment
        return run(sys.executable, *arguments, env=environment, cwd=self.path)

    def start(self, *arguments, **how):
        """Start a run."""
        how = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL} | how
        how = {"env": self.environment(), "stdin": subprocess.DEVNULL, "cwd": "/"} | how
        return subprocess.Popen(self.command(*arguments), **how)

    def planned(self, *targets):
        """Return the outdated results behind published figures, by default behind all of them.

        It is found in this process: files of the tree may differ from those here, imports may not.
        """
        from pipeline.config import load
        from pipeline.records.provenance import Freshness, with_dependencies

        config = load(self.config)
        specs, published = config.build_specs([MAIN]), config.figures()
        drawings = [published[path][1] for path in targets or published]
        return set(Freshness(self.path, specs).outdated(with_dependencies(specs, drawings)))

    def published(self):
        """Name -> (bytes, inode, mtime) of each file in paper_figures/."""
        return {
            file.name: (file.read_bytes(), file.stat().st_ino, file.stat().st_mtime_ns)
            for file in (self.path / "paper_figures").iterdir()
        }

    def append(self, file, text="_EDITED = 1\n"):
        """Append code to a source file, by default a line without an effect."""
        with (self.path / "src" / file).open("a") as source:
            source.write(text)

    def take(self, other, word):
        """Copy the results and published figures of another tree that have a word in the name."""
        for folder in ("results/paper", "paper_figures"):
            for file in (other.path / folder).rglob(f"*{word}*"):
                place = self.path / file.relative_to(other.path)
                place.parent.mkdir(exist_ok=True)
                shutil.copy(file, place)

    def make_here(self, *targets):
        """Make results with records in this process, whose code is that of this tree."""
        from pipeline.config import load
        from pipeline.records.provenance import Freshness, recorded

        specs = Freshness(self.path, load(self.config).build_specs()).build_specs
        make_here(self.path, specs, targets, recorded)

    def is_here(self, monkeypatch):
        """Let this process take it for the project, for one test."""
        monkeypatch.setattr(sources, "ROOT", self.path)
        monkeypatch.setattr(sources, "SRC", self.path / "src")

    def copy(self, path):
        """Copy it with its results."""
        shutil.copytree(self.path, path, symlinks=True, ignore=NO_CACHES)
        return Tree(path, cold=True)


def fresh_tree(path, document=None, results_of=None):
    """Make the files of a fresh clone: sources, a config, and figures newer than anything.

    `document` is its config, by default the shipped scenes with little work. A text file stands for
    each committed figure. `results_of` is a tree whose results are copied, as from a cache.
    """
    path.mkdir(parents=True)
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(source, path / part, ignore=NO_CACHES)
        else:
            shutil.copy2(source, path / part)
    tree = Tree(path, cold=True)
    tree.write(document or small(shipped()))
    figures = path / "paper_figures"
    figures.mkdir()
    for scene, block in tree.document()["scenes"].items():
        for extension in {"png", *block.get("formats", [])} - {"pdf"}:
            file = figures / f"{scene}.{extension}"
            file.write_text("committed")
            os.utime(file, (4e9, 4e9))
    if results_of:
        shutil.copytree(results_of.path / "results", path / "results", copy_function=shutil.copy)
    return tree


def make_here(folder, specs, targets, around=nullcontext):
    """Make results and what they need in a folder, by the code that this process has loaded.

    `specs` are build specifications. Results that exist stay. `around(spec)` is a context manager.
    """
    from pipeline.records.provenance import with_dependencies

    with chdir(folder):
        for path in with_dependencies(specs, targets):
            if not Path(path).exists():
                with around(specs[path]):
                    import_module(f"pipeline.jobs.{specs[path].program}").make(specs[path])


def small(document):
    """Reduce a config to the paper's scenes with as little work as shows that they work."""
    document |= {part: {} for part in ("variants", *APART)}
    for block in document["scenes"].values():
        if isinstance(block.get("impacts"), list):
            block["impacts"] = [30 for _ in block["impacts"]]
        elif "impacts" in block:
            block["impacts"] = 60
        if "records" in block:
            block["records"] = 6
        if "resolution" in block:
            distance = block["resolution"]["distance"] * (1 if "window" in block else 100)
            block["resolution"] = {"distance": distance, "bend": 60}
        for branch in block.get("branches", {}).values():
            branch["length"] = 0.2
    return document


def of_scenes(*names, **parts):
    """A small config of some of the shipped scenes, drawn as png, with further parts."""
    document = small(shipped())
    scenes = {name: document["scenes"][name] | {"formats": ["png"]} for name in names}
    apart = {part: {} for part in APART}
    return {"ball": document["ball"], "scenes": scenes} | apart | parts


def wait_for(condition, seconds=60):
    """Wait until `condition()` is true; fail after some seconds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds} s"
        time.sleep(0.05)


@contextmanager
def locked(path):
    """Hold a lock file, after any other process has released it."""
    with open(path, "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def once(folder, make):
    """Fill a folder by `make(folder)` in the first process that asks for it."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    done = folder.with_name(f"{folder.name}.done")
    with locked(folder.with_name(f"{folder.name}.lock")):
        if not done.exists():
            shutil.rmtree(folder, ignore_errors=True)  # left by a process that failed
            make(folder)
            done.touch()
    return folder
