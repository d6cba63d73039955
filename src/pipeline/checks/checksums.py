"""SHA256SUMS: the checksum list of a folder of published files."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from ..config.paths import SHOWN
from ..records.files import read_text

SUMS = "SHA256SUMS"
# A name that contains a folder could lead out of this folder.
_LINE = re.compile(r"([0-9a-f]{64})  (?!\.\.?$)([^/]+)")


class ChecksumError(Exception):
    """One line about a checksum list or manifest that cannot be read; it names the file."""


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


def unlisted_files(root: Path, folder: str, names: Iterable[str]) -> list[str]:
    """Return a line for each picture in a published folder whose name is not in `names`."""
    pictures = {path.name for path in (root / folder).glob("[!.]*") if path.suffix[1:] in SHOWN}
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
