"""A copy of the project in a folder of its own, driven as a user drives it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from numba.core.caching import _CacheLocator

from pipeline.records import sources
from pseudorigid.kernel import compiled

ROOT = Path(__file__).parents[1]
PARTS = (
    "Snakefile",
    "config.yaml",
    "pyproject.toml",
    "reproduce",
    "requirements",
    "src",
    "workflow",
)


class Tree:
    """A copy of the project at `path`, without results, sharing the running interpreter."""

    def __init__(self, path):
        self.path = path
        for part in PARTS:
            source = ROOT / part
            if source.is_dir():
                ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
                shutil.copytree(source, path / part, ignore=ignored)
            else:
                shutil.copy(source, path / part)
        self.original = {
            file: file.read_bytes()
            for part in PARTS
            for file in [path / part, *(path / part).rglob("*")]
            if file.is_file()
        }

        self.warm()

    def warm(self):
        """Bring compiled code along; numba keeps it in a folder named after the source's place."""
        for package in (".", "sweep"):
            here, there = (
                p / package / "x.py" for p in (sources.PACKAGE, self.path / "src/pseudorigid")
            )
            old, new = (_CacheLocator.get_suitable_cache_subpath(str(p)) for p in (here, there))
            cache = Path(compiled._CACHE)
            if (cache / old).is_dir():
                target = self.path / "src" / "pseudorigid" / "__pycache__" / cache.name / new
                shutil.copytree(cache / old, target)

    def restore(self):
        """Undo every edit of the copied files."""
        for file, content in self.original.items():
            if file.read_bytes() != content:
                file.write_bytes(content)

    def command(self, *arguments):
        return [sys.executable, str(self.path / "workflow" / "launch.py"), *arguments]

    def run(self, *arguments):
        """Run to the end; the result's stdout holds all that a user sees."""
        return subprocess.run(
            self.command(*arguments),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd="/",
            check=False,
        )

    def planned(self, *targets):
        """The outputs of the jobs that a run would start now, without their records."""
        result = self.run(*targets, "-n", "--quiet", "host")
        assert result.returncode == 0, result.stdout
        return set(re.findall(r"^    output: ([^\s,]+)", result.stdout, re.MULTILINE))

    def edit(self, scene, **fields):
        """Change fields of a scene in config.yaml; None removes one."""
        path = self.path / "config.yaml"
        document = yaml.safe_load(path.read_text())
        block = document["scenes"][scene] | fields
        document["scenes"][scene] = {k: v for k, v in block.items() if v is not None}
        path.write_text(yaml.safe_dump(document, sort_keys=False))

    def shrink(self):
        """Leave of the config's scenes as little work as shows that they work."""
        path = self.path / "config.yaml"
        document = yaml.safe_load(path.read_text())
        for block in document["scenes"].values():
            if isinstance(block.get("impacts"), list):
                block["impacts"] = [30 for _ in block["impacts"]]
            elif "impacts" in block:
                block |= {"impacts": 60, "records": 6}
            if "resolution" in block:
                block["resolution"] = {
                    "distance": 100 * block["resolution"]["distance"]
                    if "window" not in block
                    else block["resolution"]["distance"],
                    "bend": 60,
                }
            for branch in block.get("branches", {}).values():
                branch["length"] = 0.2
        path.write_text(yaml.safe_dump(document, sort_keys=False))

    def published(self):
        """Name -> (bytes, inode, mtime) of everything in paper_figures/."""
        return {
            file.name: (file.read_bytes(), file.stat().st_ino, file.stat().st_mtime_ns)
            for file in (self.path / "paper_figures").iterdir()
        }


@pytest.fixture
def tree(tmp_path):
    """A fresh clone, as far as files go: sources, and figures newer than anything."""
    return fresh_tree(tmp_path / "a fresh clone")


def fresh_tree(path):
    """A Tree with a small config and a stand-in for every committed figure, dated in the future."""
    path.mkdir()
    tree = Tree(path)
    tree.shrink()
    tree.original[path / "config.yaml"] = (path / "config.yaml").read_bytes()
    figures = path / "paper_figures"
    figures.mkdir()
    for scene, block in yaml.safe_load((path / "config.yaml").read_text())["scenes"].items():
        for extension in {"png", *block.get("formats", [])} - {"pdf"}:
            file = figures / f"{scene}.{extension}"
            file.write_text("committed")
            os.utime(file, (4e9, 4e9))
    return tree


@pytest.fixture(scope="session")
def accepted(tmp_path_factory):
    """A copy of the project whose small figures were made and accepted."""
    tree = fresh_tree(tmp_path_factory.mktemp("verify") / "accepted here")
    for word in ((), ("accept",)):
        result = tree.run(*word)
        assert result.returncode == 0, result.stdout
    return tree


@pytest.fixture
def moved(accepted, tmp_path, monkeypatch):
    """A fresh copy of that folder in another place, for one fault."""
    tree = shutil.copytree(accepted.path, tmp_path / "moved", symlinks=True)
    copy = object.__new__(type(accepted))
    copy.path = tree
    monkeypatch.setattr(sources, "ROOT", tree)
    monkeypatch.setattr(sources, "PACKAGE", tree / "src" / "pseudorigid")
    return copy
