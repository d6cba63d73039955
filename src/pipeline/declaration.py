"""What a part declares: stages, sets of scenes, commands; and the parts that are there.

A part is a folder of src or of src/extensions with a module `part.py`, which has a `Part` called
PART. Files beside it are found by their names:

    __init__.py       (also in figures/)
    kinds.py          kinds of picture: the fields of their scenes
    settings.py       other mappings of config.yaml, each a class of its name; one that `computes`
                      stages (stage -> function) is a method of scenes
    figures/KIND.py   the functions `draw` and, for a kind with axes, `hidden`: what these hide;
                      for a kind with gif among its formats, `moving`: its frames
    figures/reports.py  what pictures report
    scenes.yaml       scenes and variants that it ships
    captions.toml     captions of its pictures
    examples.yaml     a small scene of each kind, for the docs and the tests
    bench.py          rows of the benchmark: calls(), and lines(seconds) on them
    README.md         its page of documentation

`reproduce` prints its help before anything is installed: only the standard library is used here,
and in each `part.py`.
"""

import importlib
import os
import traceback
from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

SRC = Path(__file__).resolve().parents[1]
# A variable of the environment: the set of scenes that a process needs. If it is the main set, the
# process reads config.yaml alone, and checks all of it.
ONLY_SET = "PSEUDORIGID_SET"
RENEW = ".venv/bin/python -m pipeline.renew"  # writes every generated file


class SourceError(ValueError):
    """A source file that is missing or cannot be loaded: one line that names it."""

    def __init__(self, path: str | os.PathLike[str], reason: Exception | str) -> None:
        frames = traceback.extract_tb(getattr(reason, "__traceback__", None))
        lines = [f"line {frame.lineno}: " for frame in frames if frame.filename == str(path)]
        place = os.path.relpath(path, SRC.parent)
        super().__init__(f"{place}: {''.join(lines[-1:])}{reason}")


class Stage(NamedTuple):
    """A function that computes a dataset from fields of a scene and from other datasets.

    It is called as f(ball, energy, *inputs, **fields), without ball and energy for scenes that have
    none. A function with the keyword `progress` is given one that reports the share done, and one
    with `folder` keeps finished parts there.
    """

    function: str  # module.function
    fields: str = ""  # the scene's fields that it takes, as far as the scene has them
    inputs: tuple[str, ...] = ()  # stages whose datasets it takes
    follows: bool = False  # it follows orbits, so that a scene's `method` decides its data too
    # A function (config, scene, specification) -> specifications, for a stage that takes datasets
    # of other scenes or that is computed in blocks. It returns the specification with all inputs,
    # after those of the blocks.
    more: str = ""
    of_block: str = ""  # the function that computes a block: the cells of a sweep that a job takes
    reads: str = ""  # a pattern of the data files that it reads, with its fields in braces
    alone: bool = False  # it uses all cores, or measures seconds: no other job runs beside it
    mem_mb: int = 1000  # megabytes that its job may take on a cluster
    runtime: int = 60  # minutes that its job, or the job of a block, may take there


class SceneSet(NamedTuple):
    """Scenes that are drawn by one command and published in one folder."""

    folder: str  # of the published files; empty if nothing is published
    command: str  # that makes them
    heading: str = ""  # in docs/figures.md
    key: str = ""  # of config.yaml, below which the scenes are; empty if a function gives them
    scenes: str = ""  # this function: module.function
    kind: str = ""  # of a scene that does not say its kind
    texts: tuple[str, ...] = ()  # other files that the command writes


class Command(NamedTuple):
    """A command: its line in the list of commands, its arguments, and the module that runs it.

    An argument has a help text, or keyword arguments of argparse's add_argument. With a text alone
    it is a switch if its name begins with --, otherwise any number of names.
    """

    line: str
    arguments: Mapping[str, Any] = {}
    # It has a function run(args) -> exit status; by default the command's one in cli.commands.
    module: str = ""
    details: str = ""
    runs_snakemake: bool = False
    packages: str = ""  # a list in requirements/ that it installs first
    needs: tuple[str, ...] = ()  # other parts
    group: str = "parts"  # of the list of commands, one of command_list.GROUPS


# Such a command also reads -n and --cores, and what follows -- goes to snakemake. Without a module
# of its own, it makes the set of scenes of its name.
SnakemakeCommand = partial(Command, runs_snakemake=True, module="pipeline.cli.commands.figures")


class Part(NamedTuple):
    """What a part adds, beside the files in its folder."""

    package: str = ""  # of its folder, known when it is loaded
    needs: tuple[str, ...] = ()  # other parts without which its modules cannot be loaded
    stages: Mapping[str, Stage] = {}
    sets: Mapping[str, SceneSet] = {}  # by their folders in results/
    commands: Mapping[str, Command] = {}  # one of the engine's names replaces the engine's
    folders: tuple[str, ...] = ()  # in results/, of its commands; no variant has such a name
    committed: str = ""  # a function () -> committed file that pipeline.renew writes -> its text
    # Result -> its seconds on one core. The longest jobs begin first, so that none of them is left
    # over at the end, when the other cores are idle.
    seconds: Mapping[str, int] = {}


@cache
def _declared() -> dict[str, Part]:
    """Map the name of each part, that of its folder, to what it declares."""
    found = {}
    for file in (*sorted(SRC.glob("*/part.py")), *sorted(SRC.glob("extensions/*/part.py"))):
        package = ".".join(file.parent.relative_to(SRC).parts)
        found[file.parent.name] = imported(f"{package}.part.PART")._replace(package=package)
    return found


@cache
def parts() -> dict[str, Part]:
    """Return the parts whose needed parts are all there, each after those that it needs."""
    declared, found = _declared(), dict[str, Part]()

    def add(name: str) -> bool:
        if name in declared and name not in found and all(map(add, declared[name].needs)):
            found[name] = declared[name]
        return name in found

    for name in declared:
        add(name)
    return found


def lacking(command: str) -> str | None:
    """Return a part that is not there and that a command needs, or None."""
    for part in _declared().values():
        if command in part.commands:
            needed = (*part.needs, *part.commands[command].needs)
            return next((name for name in needed if name not in parts()), None)
    return None


def imported(name: str) -> Any:
    """Return what a name MODULE.NAME stands for; raises SourceError if there is none."""
    module, _, last = name.rpartition(".")
    try:
        return getattr(importlib.import_module(module), last)
    except (ModuleNotFoundError, AttributeError) as error:
        path = SRC.joinpath(*module.split(".")).with_suffix(".py")
        raise SourceError(path, error) from error


def hidden_by(drawn_by: str, block: dict[str, Any], *datasets: Any) -> list[str]:
    """Return lines on what the axes of a scene hide, from the function `hidden` beside its `draw`.

    Without this function, or without axes, nothing is hidden.
    """
    module = importlib.import_module(drawn_by.rpartition(".")[0])
    given = "axes" in block and hasattr(module, "hidden")
    return [*module.hidden(block, *datasets)] if given else []


def files(name: str) -> dict[str, Path]:
    """Map the package of each part that has a file of this name to the file."""
    found = {p.package: SRC.joinpath(*p.package.split("."), name) for p in parts().values()}
    return {package: file for package, file in found.items() if file.is_file()}
