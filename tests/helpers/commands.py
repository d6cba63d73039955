"""Commands that are answered in this process."""

import os
from contextlib import chdir
from unittest.mock import patch

from helpers.project import ROOT
from pipeline.cli.main import main


def answer(capsys, *words):
    """Return the exit status, stdout and stderr of a command that makes nothing.

    The environment of the tests has all packages that such a command could install first.
    """
    starts = patch("pipeline.cli.running._run", side_effect=AssertionError("a run would start"))
    with chdir(ROOT), patch.dict(os.environ), starts, patch("pipeline.cli.packages.add_packages"):
        try:
            status = main(list(words))
        except SystemExit as end:
            status = end.code
    return status, *capsys.readouterr()


def mistake(capsys, line):
    """Return the one line about a mistaken command, without what config.yaml has."""
    status, out, err = answer(capsys, *line.split())
    assert (status, out, err.count("\n")) == (2, "", 1)
    return err.removeprefix("reproduce").partition(" config.yaml has ")[0].rstrip()
