"""Set the site with Sphinx."""

import shutil
import subprocess
import sys
from pathlib import Path

from pipeline.config import Config

from .pages import pages

# Entries of the repository that the pages show or link.
_ENTRIES = ("docs", "src", "tests", "workflow", "requirements", "paper_figures", "more_figures")


def build(root: Path, config: Config, folder: Path) -> None:
    """Write the pages of the tree at `root` into a new folder.

    Sphinx reads a folder beside it, with copies of the tree's files and the pages of this run.
    A warning of Sphinx, such as one of a link without a target, is a ValueError.
    """
    sources = folder.with_name("sources")
    (sources / "pages").mkdir(parents=True)
    for file in root.iterdir():
        if file.is_file() and file.name[0] != ".":
            shutil.copyfile(file, sources / file.name)
    for name in _ENTRIES:
        shutil.copytree(root / name, sources / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name, text in pages(root, config).items():
        (sources / "pages" / f"{name}.md").write_text(text, encoding="utf-8")
    settings, doctrees = str(Path(__file__).parent), str(folder.with_name("doctrees"))
    options = ["-q", "-W", "--keep-going", "-c", settings, "-d", doctrees]
    result = subprocess.run(
        [sys.executable, "-P", "-m", "sphinx", "-b", "html", *options, str(sources), str(folder)],
        capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
    )  # fmt: skip
    if result.returncode:
        raise ValueError(" ".join(result.stderr.split()) or "Sphinx failed")
    shutil.copyfile(folder / "README.html", folder / "index.html")
    moving = "more_figures/publication"  # shown by an element of HTML, whose files Sphinx leaves
    shutil.copytree(root / moving, folder / moving)
    for name in (".buildinfo", "objects.inv"):
        (folder / name).unlink(missing_ok=True)
