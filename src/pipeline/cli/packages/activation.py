"""The scripts in .venv/bin, in a folder of any name, and after it has moved.

Installers write the place of .venv into these scripts. `adopt` replaces it, and `place_scripts`
renews it where the folder has moved. Only the standard library is used: no package is there yet.
"""

import os
import re
import shutil
from pathlib import Path

_VENV = "@VENV@"  # the place of .venv in the templates
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
# A Python script that a shell starts with the interpreter beside it.
_HEADER = b"""#!/bin/sh
'''exec' "$(dirname -- "$(readlink -f -- "$0")")"/python "$0" "$@"
' '''
"""


def adopt(venv, written):
    """Make the scripts independent of the path that the installers were given.

    Parameters
    ----------
    venv : pathlib.Path
    written : str
        The path of `venv` as its scripts have it.
    """
    templates = venv / "activate"
    for name, check in _CHECKS.items():
        if not (templates / name).exists():
            templates.mkdir(exist_ok=True)
            text = (venv / "bin" / name).read_text(encoding="utf-8")
            text = re.sub(f"[\"']?{re.escape(written)}[\"']?", _VENV, text)
            (templates / name).write_text(check + text, encoding="utf-8")
    _free(venv / "bin", written)


def place_scripts(venv):
    """Write the present place of `venv` into its scripts, and into `venv`/place."""
    venv = venv.resolve()
    place = venv / "place"
    if place.exists():
        _free(venv / "bin", _read(place))
    for name in _CHECKS:
        text = _read(venv / "activate" / name).replace(_VENV, _quoted(str(venv), name))
        _write(venv / "bin" / name, os.fsencode(text))
    _write(place, os.fsencode(venv))


def _free(folder, written):
    """Let the Python scripts in a folder find the interpreter beside them."""
    path = re.escape(os.fsencode(f"{written}/bin/python")) + rb"[\d.]*"
    trick = rb"/bin/sh\n'''exec' [\"']?" + path + rb"[\"']? \"\$0\" \"\$@\"\n' '''\n"
    head = re.compile(rb"\A#!(?:" + path + rb"\n|" + trick + rb")")
    for file in folder.iterdir():
        if file.is_file() and not file.is_symlink() and file.stat().st_size < 100_000:
            text = file.read_bytes()
            if head.match(text):
                _write(file, head.sub(lambda _: _HEADER, text, count=1))


def _quoted(text, name):
    """Quote text for the shell that reads the script `name`."""
    if name.endswith(".fish"):
        escaped = text.replace("\\", "\\\\").replace("'", "\\'")
    else:
        escaped = text.replace("'", "'\\''")
    if name.endswith(".csh"):
        escaped = escaped.replace("!", "\\!").replace("\n", "\\\n")
    return f"'{escaped}'"


def _read(file):
    return os.fsdecode(file.read_bytes())


def _write(file, content):
    """Replace a file by one with other content and the same mode."""
    part = Path(f"{file}.part")
    part.write_bytes(content)
    if file.exists():
        shutil.copymode(file, part)
    part.replace(file)
