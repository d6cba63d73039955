"""Whether this tree has the committed bytes, and if not, what differs; nothing is computed again.

Red, and exit 1: bytes that differ, of a published file or its data; results that this tree's
config and sources did not make; a contract that is broken. A note, and exit 0: whatever else
differs behind the committed bytes.
"""

from ..records.files import file_hash, obstacle
from . import manifest, published_sets
from .checksums import SUMS, ChecksumError, known_sums, read_sums, unlisted_files
from .difference import UPSTREAM, Comparison, not_as_made
from .freshness import MISSING

NEW = "new: ./reproduce accept adds it to the contract"


def verify(root, checked, strict=False):
    """Print what differs between a tree and its contracts; 0 where nothing is red.

    Notes are red too where `strict` is true.
    """
    status = 0
    for published_set in published_sets.committed_sets(checked):
        if not published_set.on_request or manifest.is_present(root, published_set):
            red, notes = _verify(root, published_set)
            status |= bool(red or (strict and notes))
    return status


def _verify(root, published_set):
    """(red findings, notes), having printed a line or more for each published file and each."""
    try:
        committed = manifest.read(root, published_set.folder)
        findings = _surplus(root, published_set, manifest.figures(committed))
    except ChecksumError as error:
        committed, findings = None, [f"{error}: the layers cannot be compared"]
    findings += _sums(root, published_set, committed)
    for path in published_set.texts if committed else ():
        if file_hash(root / path) != committed["texts"].get(path):
            findings.append(f"{path}: not the committed one: {published_set.command} writes it")
    comparison = committed and Comparison(root, published_set, committed)
    stale = not_as_made(root, published_set, comparison)
    width = max(map(len, published_set.drawn), default=0)
    different, behind = [], []
    for name in published_set.drawn:
        lines, notes = _verdict(root, published_set, name, comparison, stale)
        different += [name] if lines else []
        behind += [(name, words) for words in notes]
        first, *more = lines or ["new" if notes == [NEW] else "identical"]
        print(f"{name:{width}}  {first}")
        for line in more:
            print(f"{'':{width}}  {line}")
    made = [(path, f"{why}: run {published_set.command}") for path, why in stale.items()]
    findings += _grouped((path, why) for path, why in made if stale[path] != MISSING)
    notes = [f"note: {line}" for line in _grouped(behind)]
    print("", *findings, *notes, sep="\n")
    _say_what_is_missing(published_set, [path for path, why in stale.items() if why == MISSING])
    new = sum(words == NEW for _, words in behind)
    identical = len(published_set.drawn) - len(different) - new
    print(f"{identical} of {len(published_set.drawn)} {published_set.what} identical", end="")
    print(_counted(len(findings), "other finding") + _counted(len(notes), "note"))
    return different + findings, notes


def _verdict(root, published_set, name, comparison, stale):
    """(lines on what is wrong with a published file, notes on what differs behind it)."""
    if comparison is None:
        return _by_sums(root, published_set, name), []
    layers = comparison.layers(name)
    if layers is None:
        return [], [NEW]
    words = [f"{layer}: {text}" for layer, text in layers.items()]
    # Another config shows in the bytes, or does not matter, once its own results are here.
    current = published_set.on_request or published_set.drawn[name] not in stale
    harmless = UPSTREAM if current else UPSTREAM - {"config"}
    return ([], words) if set(layers) <= harmless else (words, [])


def _by_sums(root, published_set, name):
    """What is wrong with a published file where there is no manifest to ask."""
    wanted = known_sums(root, published_set.folder).get(name)
    digest = file_hash(root / published_set.folder / name)
    if digest is None:
        return [f"file: {obstacle(root / published_set.folder / name) or MISSING}"]
    if wanted is None:
        return ["file: nothing to compare it with"]
    return [f"file: {'as in' if digest == wanted else 'differs from'} SHA256SUMS"]


def _sums(root, published_set, committed):
    """What is wrong with SHA256SUMS, the files apart."""
    try:
        sums = read_sums(root, published_set.folder)
    except ChecksumError as error:
        return [str(error)]
    if committed is None:
        return []
    path, listed = f"{published_set.folder}/{SUMS}", manifest.figures(committed)
    lost, more = sorted(set(listed) - set(sums)), sorted(set(sums) - set(listed))
    found = [f"{path}: no line for {name}" for name in lost]
    found += [f"{path}: a line for {name}, which the manifest has not" for name in more]
    return found + [
        f"{path}: not the hash of {name} that MANIFEST.json has"
        for name, entry in listed.items()
        if sums.get(name, entry["sha256"]) != entry["sha256"]
    ]


def _surplus(root, published_set, listed):
    """Files that are there or in the manifest but that nothing makes."""
    folder = published_set.folder
    found = [
        f"{folder}/{manifest.MANIFEST}: lists {name}, which config.yaml does not publish: "
        "./reproduce accept takes it out"
        for name in sorted(set(listed) - set(published_set.drawn))
    ]
    return found + unlisted_files(root, folder, {*published_set.drawn, *published_set.measured})


def _grouped(pairs):
    """One line for each kind of words, with all that they are said of."""
    kinds = {}
    for what, words in pairs:
        kinds.setdefault(words, []).append(what)
    return [f"{_listed(what)}: {words}" for words, what in kinds.items()]


def _listed(paths):
    more = f" and {len(paths) - 4} more" if len(paths) > 5 else ""
    return ", ".join(paths[:4] if more else paths) + more


def _counted(number, what):
    return f"; {number} {what}{'s' * (number > 1)}" if number else ""


def _say_what_is_missing(published_set, missing):
    if missing and set(missing) == set(published_set.build_specs):
        how = f"{published_set.command} makes the rest"
        print(f"no results here: only the committed files were checked ({how})")
    elif missing:
        print(f"not checked, since not there: {_listed(missing)}")
