"""The hashes of the files of a contract: SHA256SUMS, in its folder."""

SUMS = "SHA256SUMS"


class ContractError(Exception):
    """One line about a contract that cannot be read; it names the file."""


def read_sums(root, folder):
    """File name -> sha256 from SHA256SUMS; raises ContractError if it is missing or broken."""
    path = f"{folder}/{SUMS}"
    found = {}
    for number, line in enumerate(text_of(root, path).splitlines(), 1):
        digest, mark, name = line[:64], line[64:66], line[66:]
        if len(digest) < 64 or set(digest) - set("0123456789abcdef") or not name or mark != "  ":
            raise ContractError(f"{path}: line {number} is not a sha256 and a file's name")
        found[name] = digest
    return found


def known_sums(root, folder):
    """The same, empty where it cannot be read."""
    try:
        return read_sums(root, folder)
    except ContractError:
        return {}


def text_of(root, name):
    """The text of a file of a contract; raises ContractError."""
    try:
        return (root / name).read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ContractError(f"{name}: missing") from None
    except (OSError, ValueError) as error:
        raise ContractError(f"{name}: cannot be read: {error}") from None
