"""./reproduce site: write one folder with all pages, the explorer and the article."""

import shutil
from contextlib import suppress
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from tempfile import TemporaryDirectory

from pipeline.cli import publishing
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import one_line
from pipeline.cli.lock import locked
from pipeline.cli.packages import add_packages
from pipeline.cli.running import interruptible
from pipeline.config import MAIN
from pipeline.records.sources import ROOT

from .. import archive

SITE, LIST = "results/site", "files.txt"  # the latter lists the files of the former
# These links are put into the explorer, which has none where it is alone.
_LINKS = '<nav><a href="index.html">Site</a> · <a href="article.html">Article</a></nav>\n</header>'


def run(args: Arguments) -> int:
    """Make missing results, then the folder, whole or not at all."""
    with locked():
        files = publishing.drawings_of(args.config, MAIN)
        status = publishing.make(args.config, {MAIN: files}, args)
        if status or args.makes_nothing:
            return status
        with one_line("site: "):
            archive.refuse_unpublished(ROOT, args.config)  # before packages are downloaded
            _refuse_others(ROOT / SITE)
    add_packages("algebra", "article", "site")  # it tells of claims and theorems
    scratch = TemporaryDirectory(prefix=".site.", dir=ROOT / "results")
    with (
        locked(),
        interruptible(),
        one_line("site: "),
        one_line("site: ", OSError),
        scratch as part,
    ):
        _write(Path(part, "new"), args)
        if (ROOT / SITE).exists():
            (ROOT / SITE).rename(Path(part, "old"))
        Path(part, "new").rename(ROOT / SITE)
    size = sum(file.stat().st_size for file in (ROOT / SITE).rglob("*") if file.is_file())
    print(f"\n{SITE}/  {size / 1e6:.1f} MB: open {SITE}/index.html (search: --serve)")
    if args.serve:
        _serve(ROOT / SITE)
    return 0


def _serve(folder: Path) -> None:
    """Serve a folder on this machine until Ctrl-C, since browsers search no pages on a disk."""
    handler = partial(SimpleHTTPRequestHandler, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server, suppress(KeyboardInterrupt):
        print(f"http://127.0.0.1:{server.server_port}/ (Ctrl-C ends it)", flush=True)
        server.serve_forever()


def _refuse_others(folder: Path) -> None:
    """Raise ValueError for a file that this command did not write: it would be deleted."""
    own = folder / LIST
    known = own.read_text(encoding="utf-8").splitlines() if own.is_file() else []
    for file in sorted(folder.rglob("*")):
        if file.is_file() and str(file.relative_to(folder)) not in known:
            raise ValueError(f"{file} was not written by this command: move it away")


def _write(folder: Path, args: Arguments) -> None:
    """Write all files of the site into a new folder."""
    from extensions.explorer import page as explorer

    from ..article import numbers, typesetting
    from ..site.build import build

    build(ROOT, args.config, folder)
    (folder / MAIN).mkdir()
    for file in sorted((ROOT / "results" / MAIN).glob("*.nc")):
        shutil.copyfile(file, folder / MAIN / file.name)
    measured = numbers.numbers_of(ROOT, args.config)
    files = {
        "explorer.html": explorer.render(args.config).replace("</header>", _LINKS, 1).encode(),
        "article.pdf": typesetting.typeset(ROOT, measured),
        "article.html": typesetting.web_page(ROOT, measured),
    }
    for name, content in files.items():
        (folder / name).write_bytes(content)
    names = sorted(str(f.relative_to(folder)) for f in folder.rglob("*") if f.is_file())
    (folder / LIST).write_text("\n".join([*names, LIST, ""]), encoding="utf-8")
