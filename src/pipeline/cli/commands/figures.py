"""./reproduce [FIGURE ...], variant, and commands that make a set of scenes, by snakemake."""

import os
from contextlib import nullcontext
from pathlib import PurePath

from ...command_list import all_commands
from ...config import MAIN, PUBLISHED
from ...declaration import ONLY_SET
from ...records.sources import ROOT
from .. import publishing, running
from ..arguments import Arguments, hint
from ..errors import CommandLineError
from ..lock import locked


def run(args: Arguments) -> int:
    """Make the files that the command and its names select; 2 if an asked variant is faulty."""
    if not (args.word or args.options):
        os.environ[ONLY_SET] = MAIN
        if not {*args.figure} <= {"all", *args.config.scenes}:
            del os.environ[ONLY_SET], args.config
    config, group, faulty = args.config, args.word, list[str]()
    if group in PUBLISHED:  # the command that makes these scenes has their name
        targets = {group: publishing.drawings_of(config, group)}
    elif group:
        variants, scenes = publishing.variants_and_scenes(args)
        faulty = [name for name in variants if name in config.faulty]
        sound = [name for name in variants if name not in faulty]
        targets = {name: publishing.drawings_of(config, name, scenes) for name in sound}
    else:
        targets = _named(args)
    # Plain -n reads only, also where nothing can be written.
    with nullcontext() if args.dry_run and not args.options else locked():
        status = publishing.make(config, targets, args) if targets else 0
    return 2 if faulty and status != running.INTERRUPTED else status


def _named(args: Arguments) -> dict[str, publishing.Drawings]:
    """Select every figure of the paper, or the named figures and files, by sets of scenes."""
    published = {
        group: publishing.drawings_of(args.config, group)
        for group in PUBLISHED
        if group in args.config.variants
    }
    targets: dict[str, publishing.Drawings] = {}
    for name in args.figure or ["all"]:
        # A path is relative to the root or to the user's folder.
        files = {os.path.normpath(name), os.path.relpath(args.start / name, ROOT)}
        found: dict[str, publishing.Drawings] = {}
        for group, drawings in published.items():
            for path, drawing in drawings.items():
                names = (scene := PurePath(drawing).stem, f"{group}/{scene}")
                if name in names or path in files or (name, group) == ("all", MAIN):
                    found.setdefault(group, {})[path] = drawing
        if "/" not in name and len(found) > 1:
            full_names = " or ".join(f"{group}/{name}" for group in found)
            raise CommandLineError(f"{name} is the name of several scenes: say {full_names}")
        found = found or {MAIN: {path: path for path in _results_among(files, name, args)}}
        for group, drawings in found.items():
            targets[group] = targets.get(group, {}) | drawings
    return targets


def _results_among(files: set[str], name: str, args: Arguments) -> list[str]:
    """Return the results among the files that a name may stand for, or raise CommandLineError."""
    results = args.config.build_specs()
    if found := sorted(files & results.keys()):
        return found
    if "/" in name:
        known = [*results, *args.config.figures()]
        raise CommandLineError(f"no such file is made: {name}{hint(name, known)}")
    if name in all_commands():
        raise CommandLineError(f"{name} is a command, no figure: run ./reproduce {name}")
    if name in (*args.config.own_variants, *args.config.ranges):
        raise CommandLineError(f"{name} is a variant, no figure: run ./reproduce variant {name}")
    scenes = [scene for group in PUBLISHED for scene in args.config.variants[group]]
    meant = hint(name, [*scenes, *all_commands()]) or ": ./reproduce list shows the figures"
    raise CommandLineError(f"no command or figure {name}{meant}")
