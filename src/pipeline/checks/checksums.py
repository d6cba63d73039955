"""The hashes of the files of a contract: SHA256SUMS, in its folder."""

from pathlib import Path

from ..config.paths import SHOWN
from ..records.files import FileError, read_text

SUMS = "SHA256SUMS"


class ChecksumError(Exception):
    """One line about a contract that cannot be read; it names the file."""


def read_sums(root, folder):
    """File name -> sha256 from SHA256SUMS; raises ContractError if it is missing or broken."""
    path = f"{folder}/{SUMS}"
    found = {}
    for number, line in enumerate(text_of(root, path).splitlines(), 1):
        digest, mark, name = line[:64], line[64:66], line[66:]
        hexadecimal = len(digest) == 64 and not set(digest) - set("0123456789abcdef")
        # A name with a folder in it could lead out of this one.
        if not hexadecimal or mark != "  " or name in ("", "..") or Path(name).name != name:
            raise ChecksumError(f"{path}: line {number} is not a sha256 and a file's name")
        found[name] = digest
    return found


def known_sums(root, folder):
    """The same, empty where it cannot be read."""
    try:
        return read_sums(root, folder)
    except ChecksumError:
        return {}


def unlisted_files(root, folder, names):
    """A line for each picture in a folder of published files that is none of `names`."""
    there = {path.name for path in (root / folder).glob("[!.]*") if path.suffix[1:] in SHOWN}
    return [
        f"{folder}/{name}: no scene of config.yaml makes it: delete it, or put its scene back"
        for name in sorted(there - set(names))
    ]


def text_of(root, name):
    """The text of a file of a contract; raises ContractError."""
    try:
        return read_text(root / name)
    except (FileNotFoundError, NotADirectoryError):
        raise ChecksumError(f"{name}: missing") from None
    except FileError as error:
        raise ChecksumError(str(error).replace(f"{root}/", "")) from None
    except UnicodeDecodeError as error:
        raise ChecksumError(f"{name}: cannot be read: {error}") from None
