"""./reproduce variant NAME and compare A B."""

import json
import sys
import time

from .. import config
from .interrupts import tidying_up
from .runner import (
    BUSY,
    ROOT,
    discard_damaged,
    floor_report,
    hold_lock,
    identity,
    last_words,
    only_said,
    run_snakemake,
    table,
)


def variant(arguments: list[str]) -> int:
    """Make one variant's figures, with the options of snakemake that follow its name."""
    variants = config.load(ROOT / "config.yaml")["variants"]
    own = [name for name in variants if name != config.PAPER]
    if not arguments or arguments[0].startswith("-"):
        print(f"reproduce: variant needs a name: config.yaml has {_listed(own)}", file=sys.stderr)
        return 1
    name, *options = arguments
    if name not in own:
        print(f"reproduce: {config.unknown('variant', name, own)}", file=sys.stderr)
        return 1
    figures = config.figures(variants, name)
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    discard(variants, [name], options)
    before = {path: identity(path) for path in figures}
    status = make([f"variant_{name}"], options)
    if status:
        return status
    absent = read_absent(name)
    rows = []
    for path, (scene, _) in figures.items():
        drawn = identity(path) != before[path]
        if scene not in absent and (drawn or not only_said(options)):
            rows.append((scene, path, "recomputed" if drawn else "current"))
    if rows:
        table(rows)
        for line in floor_report(variants, dict.fromkeys(scene for scene, _, _ in rows), name):
            print(line)
    for scene, reason in absent.items() if not only_said(options) else ():
        print(f"{scene}  cannot exist: {reason}")
    return 0


def compare(arguments: list[str]) -> int:
    """Make what is missing of two variants, and say what differs between them."""
    variants = config.load(ROOT / "config.yaml")["variants"]
    names, options = arguments[:2], arguments[2:]
    for name in names:
        if name not in variants and not name.startswith("-"):
            print(f"reproduce: {config.unknown('variant', name, list(variants))}", file=sys.stderr)
            return 1
    if len(set(names) & set(variants)) < 2:
        message = f"reproduce: compare needs two names of {_listed(variants)}"
        print(message, file=sys.stderr)
        return 1
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    discard(variants, names, options)
    targets = ["all" if name == config.PAPER else f"variant_{name}" for name in names]
    status = make(targets, options)
    if status or only_said(options):
        return status
    from ..checks.compare import compare

    with tidying_up():
        print()
        try:
            compare(ROOT, variants, names, [read_absent(name) for name in names])
        except ValueError as error:  # a damaged file, named
            sys.stdout.flush()  # or what was said before it comes after it
            print(f"reproduce: {error}".replace(f"{ROOT}/", ""), file=sys.stderr)
            return 1
    return 0


def discard(variants, names: list[str], options: list[str]) -> None:
    """Delete what is damaged of these variants' drawings and findings; it is then made again."""
    for name in names:
        discard_damaged(config.figures(variants, name), options)
        if not only_said(options):
            read_absent(name)


def make(targets: list[str], options: list[str]) -> int:
    """Run snakemake for targets that are rules; on failure say what went wrong."""
    start = time.time() - 1  # some file systems keep whole seconds only
    status = run_snakemake([*targets, *options], [])
    if status:
        for line in last_words(start):
            print(line, file=sys.stderr)
    return status


def read_absent(name: str) -> dict[str, str]:
    """Scene -> why its figure cannot exist, as the last run of a variant found.

    A damaged file counts as none and is deleted.
    """
    try:
        return json.loads((ROOT / config.absent_file(name)).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except ValueError:  # damaged
        (ROOT / config.absent_file(name)).unlink()
        return {}


def _listed(names):
    return ", ".join(names) or "none"
