"""Scripts in .venv/bin that work in a folder of any name, and after the folder has moved.

Installers write the path of .venv into these scripts. `adopt` turns them into templates, and
`place_scripts` writes the present path. No package is installed yet when this module runs.
"""

import os
import re
import shutil
from pathlib import Path

from ...records.files import replacing

_VENV = "@VENV@"  # the path of .venv in the templates
_MOVED = "reproduce: this folder has moved: run ./reproduce --version in it, then activate again"
_COLON = "reproduce: PATH cannot hold a folder with a colon in its name: use .venv/bin/python"
_CHECKS = {
    "activate": f"""\
case {_VENV} in *:*) echo '{_COLON}' >&2; return 1 ;; esac
[ -x {_VENV}/bin/python ] || {{ echo '{_MOVED}' >&2; return 1; }}
""",
    "activate.fish": f"""\
string match -q '*:*' -- {_VENV}; and echo '{_COLON}' >&2; and return 1
test -x {_VENV}/bin/python; or begin; echo '{_MOVED}' >&2; return 1; end
""",
    "activate.csh": f"if (! -x {_VENV}/bin/python) echo '{_MOVED}'\n",
}
# Start of a Python script that a shell runs with the interpreter beside the script.
_HEADER = b"""#!/bin/sh
'''exec' "$(dirname -- "$(readlink -f -- "$0")")"/python "$0" "$@"
' '''
"""


def adopt(venv: Path, written: str) -> None:
    """Make the scripts of `venv` independent of `written`, the path that the installers wrote."""
    templates = venv / "activate"
    for name, check in _CHECKS.items():
        if not (templates / name).exists():
            templates.mkdir(exist_ok=True)
            text = (venv / "bin" / name).read_text(encoding="utf-8")
            text = re.sub(f"[\"']?{re.escape(written)}[\"']?", _VENV, text)
            (templates / name).write_text(check + text, encoding="utf-8")
    _replace_headers(venv / "bin", written)


def place_scripts(venv: Path) -> None:
    """Write the present path of `venv` into its scripts and into `venv`/place."""
    venv = venv.resolve()
    place = venv / "place"
    if place.exists():
        _replace_headers(venv / "bin", _read(place))
    for name in _CHECKS:
        text = _read(venv / "activate" / name).replace(_VENV, _quoted(str(venv), name))
        _write(venv / "bin" / name, os.fsencode(text))
    _write(place, os.fsencode(venv))


def _replace_headers(folder: Path, written: str) -> None:
    """Make the Python scripts in a folder use the interpreter beside them."""
    path = re.escape(os.fsencode(f"{written}/bin/python")) + rb"[\d.]*"
    trick = rb"/bin/sh\n'''exec' [\"']?" + path + rb"[\"']? \"\$0\" \"\$@\"\n' '''\n"
    head = re.compile(rb"\A#!(?:" + path + rb"\n|" + trick + rb")")
    for file in folder.iterdir():
        if file.is_file() and not file.is_symlink() and file.stat().st_size < 100_000:
            text = file.read_bytes()
            if head.match(text):
                _write(file, head.sub(lambda _: _HEADER, text, count=1))


def _quoted(text: str, name: str) -> str:
    """Quote text for the shell that reads the script `name`."""
    if name.endswith(".fish"):
        escaped = text.replace("\\", "\\\\").replace("'", "\\'")
    else:
        escaped = text.replace("'", "'\\''")
    if name.endswith(".csh"):
        escaped = escaped.replace("!", "\\!").replace("\n", "\\\n")
    return f"'{escaped}'"


def _read(file: Path) -> str:
    return os.fsdecode(file.read_bytes())


def _write(file: Path, content: bytes) -> None:
    """Replace a file's content and keep its mode."""
    with replacing(file) as part:
        part.write_bytes(content)
        if file.exists():
            shutil.copymode(file, part)
