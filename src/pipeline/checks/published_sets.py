"""The sets of published files that must keep their bytes: what makes them, and their checksums.

They are the figures of the paper, the study's charts, and the pictures of extensions.
"""

import re
from collections.abc import Collection, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ..config import MAIN, Config
from ..config.results import SHOWN, drawn
from ..config.schema.parts import PUBLISHED, SETS
from ..records.files import file_hash, read_text
from ..records.provenance import BuildSpec, git, git_refuses, with_dependencies

SUMS = "SHA256SUMS"  # the checksum list of a folder of published files
MANIFEST = "MANIFEST.json"
# A name that contains a folder could lead out of this folder.
_LINE = re.compile(r"([0-9a-f]{64})  (?!\.\.?$)([^/]+)")


class PublishedSet(NamedTuple):
    """A folder of published files and what makes them; all paths start at the project's root.

    The name of a published file is that of its scene and a suffix.
    """

    group: str  # the name of its set of scenes, a key of config.variants and a folder in results/
    folder: str  # of the published files
    command: str  # that makes the files
    text_files: tuple[str, ...]  # other files that the command writes
    on_request: bool  # whether only its own command makes it; plain ./reproduce makes the paper's
    drawn: dict[str, str]  # name of a published file -> its drawing in results
    data: dict[str, dict[str, str]]  # scene -> stage -> the dataset that it is drawn from
    build_specs: dict[str, BuildSpec]  # every result

    def without(self, scenes: Collection[str]) -> "PublishedSet":
        """Return the set without some scenes, which cannot exist."""
        return self._replace(
            drawn={n: path for n, path in self.drawn.items() if Path(n).stem not in scenes},
            data={scene: stages for scene, stages in self.data.items() if scene not in scenes},
            build_specs={p: s for p, s in self.build_specs.items() if s.scene not in scenes},
        )

    def is_committed(self, root: Path) -> bool:
        """Return whether the folder has a manifest or a checksum list."""
        return any((root / self.folder / name).exists() for name in (MANIFEST, SUMS))


def committed_sets(config: Config) -> list[PublishedSet]:
    """Return all published sets of a checked config."""
    return [_published(config, name) for name in PUBLISHED if config.variants[name]]


def _published(config: Config, group: str) -> PublishedSet:
    """Return the published set of a group of scenes."""
    scenes = {name: block for name, block in config.variants[group].items() if block.formats}
    drawings = [drawn(n, suffix, group) for n, block in scenes.items() for suffix in block.formats]
    specs = config.build_specs([group])
    return PublishedSet(
        group=group,
        folder=PUBLISHED[group],
        command=SETS[group].command,
        text_files=SETS[group].texts,
        on_request=group != MAIN,
        drawn={Path(path).name: path for path in drawings if Path(path).suffix[1:] in SHOWN},
        data={scene: config.data_of(group, scene) for scene in scenes},
        build_specs={path: specs[path] for path in with_dependencies(specs, drawings)},
    )


# -- checksum lists --------------------------------------------------------------------------------


def format_sums(sums: Mapping[str, str]) -> str:
    """Return the text of a checksum list (file name -> SHA-256), as sha256sum writes it."""
    return "".join(f"{digest}  {name}\n" for name, digest in sums.items())


def read_sums(root: Path, folder: str) -> dict[str, str]:
    """Return file name -> SHA-256 from a folder's checksum list; empty if it cannot be read."""
    try:
        lines = read_text(root / folder / SUMS).splitlines()
    except (OSError, ValueError):
        return {}
    return {match[2]: match[1] for match in map(_LINE.fullmatch, lines) if match}


def committed_state(root: Path, path: str) -> str:
    """Say how a published file compares with the checksum list of its folder.

    If git says that the list was edited, or nothing, the words say so after ": ".
    """
    folder, _, name = path.rpartition("/")
    digest, sums = file_hash(root / path), read_sums(root, folder)
    if digest is None:
        return "missing"
    if name not in sums:
        return "not committed"
    state = "identical" if digest == sums[name] else "differs"
    why = edited_lists(root).get(f"{folder}/{SUMS}")
    return f"unknown: {state} by {SUMS}, which is {why}" if why else state


@cache
def edited_lists(root: Path) -> dict[str, str]:
    """Map each checksum list and manifest that may not be the committed one to words about that.

    Without a repository, as in an unpacked archive, there are none.
    """
    files = [f"{folder}/{name}" for folder in PUBLISHED.values() for name in (SUMS, MANIFEST)]
    names = git("diff", "--name-only", "--relative", "-z", "HEAD", "--", *files, root=root)
    if names is None and git_refuses(root):
        return dict.fromkeys(files, "not known to be the committed one, see git status")
    edited = (names or b"").decode().split("\0")[:-1]
    return dict.fromkeys(edited, "not the committed one, see git diff")


def unlisted_files(
    root: Path, group: str, names: Collection[str], impossible: Mapping[str, str] = {}
) -> dict[str, str]:
    """Map each picture in a set's published folder whose name is not in `names` to words about it.

    `impossible` maps scenes that cannot exist to the reasons.
    """
    found = {}
    for path in sorted((root / PUBLISHED[group]).glob("[!.]*")):
        if path.suffix[1:] in SHOWN and path.name not in names:
            why = impossible.get(path.stem)
            words = f"its scene cannot exist: {why}" if why else "no scene makes it"
            end = "change its scene" if why else "put its scene back"
            place = f"{PUBLISHED[group]}/{path.name}"
            removes = "./reproduce accept removes it"
            how = removes if is_left_over(root, group, path.name) else "delete it"
            found[place] = f"{place}: {words}: {how}, or {end}"
    return found


def is_left_over(root: Path, group: str, name: str) -> bool:
    """Return whether a published file is a drawing that was made here, and git does not track it.

    Drawings stay in results when their scenes go.
    """
    path = f"{PUBLISHED[group]}/{name}"
    if file_hash(root / path) != file_hash(root / f"results/{group}/figures/{name}"):
        return False
    return git("ls-files", "--", path, root=root) == b""  # None without a repository
