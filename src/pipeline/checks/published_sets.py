"""The sets of published files that must keep their bytes: what makes them, and their checksums.

They are the figures of the paper, the pictures of claims, families and proofs, the study's charts
whose data are the same on every machine, and the atlas.
"""

import re
from collections.abc import Collection, Iterable, Mapping
from functools import cache
from itertools import product, starmap
from pathlib import Path
from typing import Any, NamedTuple

from pseudorigid.sweep import grid

from ..config import PAPER, build_specs, paths
from ..config.schema import study as parts
from ..config.schema.published import FOLDERS
from ..records.build_spec import BuildSpec
from ..records.files import file_hash, read_text
from ..records.record import git

COMMANDS = {
    PAPER: "./reproduce",
    "claims": "./reproduce claims",
    "families": "./reproduce families",
    "proofs": "./reproduce prove --pictures",
    "study": "./reproduce study",
    "sweep": "./reproduce atlas",
}
SUMS = "SHA256SUMS"  # the checksum list of a folder of published files
MANIFEST = "MANIFEST.json"
IDENTICAL = "identical to the committed one"
# A name that contains a folder could lead out of this folder.
_LINE = re.compile(r"([0-9a-f]{64})  (?!\.\.?$)([^/]+)")
_Blocks = dict[str, dict[str, Any]]  # scene -> the config block that decides it
_Data = dict[str, dict[str, str]]  # scene -> stage -> the dataset that it is drawn from


class ChecksumError(Exception):
    """One line about a checksum list or manifest that cannot be read; it names the file."""


class PublishedSet(NamedTuple):
    """A folder of published files and what makes them; all paths start at the project's root.

    The name of a published file is that of its scene and a suffix.
    """

    group: str  # its name: "paper", "study" or the like
    drawn: dict[str, str]  # name of a published file -> its drawing in results
    config: _Blocks
    data: _Data
    build_specs: dict[str, BuildSpec]  # every result
    measured: tuple[str, ...]  # published files without a checksum: they show times

    @property
    def folder(self) -> str:
        """The folder of the published files."""
        return FOLDERS[self.group]

    @property
    def results(self) -> str:
        """The folder of the drawings and their data."""
        return f"results/{self.group}"

    @property
    def command(self) -> str:
        """The command that makes the files."""
        return COMMANDS[self.group]

    @property
    def on_request(self) -> bool:
        """Whether only a command of its own makes the set, and not every run."""
        return self.group != PAPER

    @property
    def texts(self) -> tuple[str, ...]:
        """Other files that the command writes."""
        return (paths.LEDGER, paths.LEDGER_DATA) if self.group == "claims" else ()

    def sources(self, scene: str) -> list[str]:
        """Return the project's files that decide a scene's figures."""
        drawn = [path for name, path in self.drawn.items() if Path(name).stem == scene]
        results = [*self.data[scene].values(), *drawn]
        return sorted({file for path in results for file in self.build_specs[path].sources})

    def without(self, scenes: Collection[str]) -> "PublishedSet":
        """Return the set without some scenes."""
        return self._replace(
            drawn={n: path for n, path in self.drawn.items() if Path(n).stem not in scenes},
            config={scene: block for scene, block in self.config.items() if scene not in scenes},
            data={scene: stages for scene, stages in self.data.items() if scene not in scenes},
            build_specs={p: s for p, s in self.build_specs.items() if s.scene not in scenes},
        )

    def unlisted(self, root: Path) -> list[str]:
        """Return a line for each picture in the folder that the set does not have."""
        return unlisted_files(root, self.folder, {*self.drawn, *self.measured})


def committed_sets(checked: dict[str, Any]) -> list[PublishedSet]:
    """Return all published sets of a checked config."""
    variants = checked["variants"]
    sets = [_figures(variants, name) for name in paths.PUBLISHED if variants[name]]
    return [*sets, _study(variants), _atlas(checked["sweeps"])]


def _set(
    group: str, config: _Blocks, data: _Data, specs: dict[str, BuildSpec], *measured: str
) -> PublishedSet:
    """Return the set with the drawings among these results."""
    drawn = {Path(path).name: path for path, spec in specs.items() if spec.program == "draw"}
    shown = {name: path for name, path in drawn.items() if Path(name).suffix[1:] in paths.SHOWN}
    return PublishedSet(group, shown, config, data, specs, measured)


def _figures(variants: paths.Variants, variant: str) -> PublishedSet:
    """Return the figures of the paper, or the pictures of claims, families or proofs."""
    scenes = variants[variant]
    config = {scene: paths.drawing(block) for scene, block in scenes.items()}
    data: _Data = {scene: {} for scene in scenes}
    for (name, scene, stage), path in paths.artifact_paths(variants).items():
        if name == variant:
            data[scene][stage] = path
    return _set(variant, config, data, build_specs.of_variants(variants, [variant]))


def _study(variants: paths.Variants) -> PublishedSet:
    """Return the study's charts of what is computed; charts of times are listed as measured."""
    specs = build_specs.of_study(variants)
    charts = {name: part for name, (part, *_) in parts.CHARTS.items() if part in parts.FIXED}
    fixed = {*map(parts.data, parts.FIXED), *starmap(parts.drawn, product(charts, parts.FORMATS))}
    config = {n: parts.drawing(n) | specs[parts.data(p)].config for n, p in charts.items()}
    data = {name: {part: parts.data(part)} for name, part in charts.items()}
    others = (name for name in parts.CHARTS if name not in charts)
    measured = map(".".join, product(others, parts.FORMATS))
    specs = {path: spec for path, spec in specs.items() if path in fixed}
    return _set("study", config, data, specs, *measured)


def _atlas(sweeps: dict[str, Any]) -> PublishedSet:
    """Return the pictures of the sweeps. A picture of chains is a scene of its own."""
    config = {name: grid.whole(sweep) for name, sweep in sweeps.items()}
    data = {name: {"sweep": paths.sweep_dataset(name)} for name in sweeps}
    for name, sweep in sweeps.items():
        if "chains" in sweep:
            scene = Path(paths.chains_picture(name)).stem
            config[scene] = grid.whole(sweep) | {"chains": sweep["chains"]}
            data[scene] = data[name] | {"chains": paths.chains_dataset(name)}
    return _set("sweep", config, data, build_specs.of_sweeps(sweeps))


# -- checksum lists --------------------------------------------------------------------------------


def format_sums(sums: Mapping[str, str]) -> str:
    """Return the text of a checksum list (file name -> sha256), as sha256sum writes it."""
    return "".join(f"{digest}  {name}\n" for name, digest in sums.items())


def read_sums(root: Path, folder: str) -> dict[str, str]:
    """Return file name -> sha256 from a folder's list; empty if it cannot be read."""
    try:
        lines = read_published_text(root, f"{folder}/{SUMS}").splitlines()
    except ChecksumError:
        return {}
    return {match[2]: match[1] for match in map(_LINE.fullmatch, lines) if match}


def committed_state(root: Path, path: str) -> str:
    """Say how a published file compares with the one in the checksum list of its folder."""
    folder, _, name = path.rpartition("/")
    digest, sums = file_hash(root / path), read_sums(root, folder)
    if digest is None:
        return "missing"
    if name not in sums:
        return "not committed"
    state = IDENTICAL if digest == sums[name] else "differs from the committed one"
    edited = f"{folder}/{SUMS}" in edited_lists(root)
    words = f"{SUMS}, which is not as committed"
    return state.replace("the committed one", words) if edited else state


@cache
def edited_lists(root: Path) -> list[str]:
    """Return the checksum lists and manifests that differ from the last commit, if git says so."""
    files = [f"{folder}/{name}" for folder in FOLDERS.values() for name in (SUMS, MANIFEST)]
    names = git("diff", "--name-only", "--relative", "-z", "HEAD", "--", *files, root=root) or b""
    return names.decode().split("\0")[:-1]


def unlisted_files(root: Path, folder: str, names: Iterable[str]) -> list[str]:
    """Return a line for each picture in a published folder whose name is not in `names`."""
    files = (root / folder).glob("[!.]*")
    pictures = {path.name for path in files if path.suffix[1:] in paths.SHOWN}
    return [
        f"{folder}/{name}: no scene of config.yaml makes it: delete it, or put its scene back"
        for name in sorted(pictures - set(names))
    ]


def read_published_text(root: Path, name: str) -> str:
    """Read a checksum list or manifest; raises ChecksumError."""
    try:
        return str(read_text(root / name))
    except (FileNotFoundError, NotADirectoryError):
        raise ChecksumError(f"{name}: missing") from None
    except ValueError as error:  # of another kind of file, or no text
        reason = str(error).removeprefix(f"{root / name}: ")
        raise ChecksumError(f"{name}: {reason}") from None
