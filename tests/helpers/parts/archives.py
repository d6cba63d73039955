"""What verify --against finds in an archive."""

import hashlib
import json
from contextlib import redirect_stdout
from io import StringIO

import netCDF4

from extensions.publication import archive
from pipeline import config

DATA = "results/paper/motion_fig3.nc"


def against(tree, place):
    """Return exit status, file -> state, and all lines of verify --against."""
    with redirect_stdout(StringIO()) as text:
        status = archive.compare(tree.path, config.load(tree.config), place)
    lines = text.getvalue().splitlines()
    rows = (line.split(maxsplit=1) for line in lines if "  " in line.strip() and line[0] != " ")
    return status, dict(rows), lines


def forge(tree, path, content=None):
    """Change a result, and its hash in all records; a dataset if there is no content."""
    file, provenance = tree.path / path, tree.path / "results" / "paper" / "provenance"
    if content is None:
        with netCDF4.Dataset(file, "a") as dataset:
            dataset["strain"][:] = 0.5 * dataset["strain"][:]
    else:
        file.write_bytes(content)
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    for record in provenance.glob("*.json"):
        content = json.loads(record.read_text())
        if content["output"]["file"] == path:
            content["output"]["sha256"] = digest
        if path in content["inputs"]:
            content["inputs"][path] = digest
        record.write_text(json.dumps(content))
