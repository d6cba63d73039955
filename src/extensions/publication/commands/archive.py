"""./reproduce archive: write the figures and what they were made from into one file."""

import platform

from pipeline.cli.arguments import Arguments
from pipeline.cli.session import CommandLineError, interruptible, locked, one_line
from pipeline.records.sources import ROOT

from .. import archive, downloads

FOLDER = "results/archive"


def run(args: Arguments) -> int:
    """Write the archive; all results must be present and current."""
    here = ".".join(platform.python_version_tuple()[:2])
    python = args.python or here
    if args.python and not args.with_packages:
        raise CommandLineError("archive: --python needs --with-packages")
    name = f"-python{python}-{platform.machine()}" if args.with_packages else ""
    file = args.file or f"{FOLDER}/pseudorigid{name}.tar"
    path = (args.start if args.file else ROOT) / file
    with locked(), interruptible(), one_line("archive: ", archive.ArchiveError):
        packages = []
        if args.with_packages:
            archive.refuse_unpublished(ROOT, args.config)  # before the download
            folder = ROOT / FOLDER / f"packages{name}"
            packages = downloads.download(folder, python)
        digest = archive.write(ROOT, args.config, path, packages)
    print(f"{digest}  {file}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
