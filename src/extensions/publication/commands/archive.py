"""./reproduce archive: write the figures and what they were made from into one file.

An archive that runs without a network has the locked packages, which are downloaded first.
"""

import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from packaging.markers import Marker

from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError, UsageError, one_line
from pipeline.cli.lock import locked
from pipeline.cli.packages import installers_environment
from pipeline.cli.running import interruptible
from pipeline.records.files import file_hash
from pipeline.records.sources import ROOT

from .. import archive

FOLDER = "results/archive"
REQUIREMENTS = ("uv", "build", "lock", "algebra")  # what the figures and the proofs need
_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


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
            packages = download(folder, python)
        digest = archive.write(ROOT, args.config, path, packages)
    print(f"{digest}  {file}  {path.stat().st_size / 1e6:.1f} MB")
    return 0


def download(folder: Path, python: str) -> list[Path]:
    """Download the locked packages for a version of Python, such as 3.13, and return the files.

    Files that are in `folder` already are kept. A package without a wheel is downloaded as source.
    UsageError, with pip's own message, if that fails.
    """
    folder.mkdir(parents=True, exist_ok=True)
    target = {"python_version": python, "python_full_version": f"{python}.0"}
    lines = [line for name in REQUIREMENTS for line in requirements_for(name, target)]
    pip = [sys.executable, "-I", "-m", "pip"]
    options = ["--no-deps", "--require-hashes", "--quiet", "--progress-bar=off"]
    options += [f"--dest={folder}", f"--python-version={python}"]
    with tempfile.TemporaryDirectory() as scratch:
        requirements = Path(scratch, "requirements.txt")
        requirements.write_text("\n".join(lines))
        result = subprocess.run(
            [*pip, "download", *options, "-r", str(requirements)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            env=installers_environment(pip),
        )
    if result.returncode:
        errors = [line for line in result.stderr.splitlines() if line.startswith("ERROR: ")]
        message = (errors or result.stderr.splitlines() or ["pip failed"])[-1]
        raise UsageError(f"cannot download the packages: {message.removeprefix('ERROR: ')}")
    wanted = set(_HASH.findall("\n".join(lines)))
    files = [file for file in sorted(folder.iterdir()) if file_hash(file) in wanted]
    if len(files) != len(lines):
        raise UsageError(f"{folder} has {len(files)} packages of {len(lines)}: delete it and retry")
    return files


def requirements_for(name: str, target: dict[str, str]) -> list[str]:
    """Return the lines of requirements/NAME.txt for a machine, without their conditions.

    Pip would evaluate the conditions for the Python that runs it. `target` maps what they name to
    the machine's values, if these are not those of this machine.
    """
    text = (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8")
    needed = []
    for line in re.findall(r"^[\w.-]+==.*", text.replace("\\\n", ""), re.MULTILINE):
        pin, *hashes = line.split(" --hash")
        pin, _, marker = pin.partition(";")
        if not marker or Marker(marker.strip()).evaluate(target):
            needed.append(" --hash".join([pin.strip(), *map(str.strip, hashes)]))
    return needed
