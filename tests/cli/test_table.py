"""Tables of files in a terminal: one row a figure, at most 80 columns, verdicts in colour."""

import sys

import pytest

from pipeline import config
from pipeline.checks.published_sets import committed_sets
from pipeline.cli.table import print_files, print_lines
from pipeline.records.sources import ROOT

HEADER = ("figure", "files", "state", "as committed")


def test_files_of_a_figure_that_say_the_same_share_a_row(capsys):
    reason = "not made: the disk is full"
    rows = [
        ("a/fig2.png", "  245 kB", ("current", "identical")),
        ("a/fig2.svg", "1,996 kB", ("current", "identical")),
        ("a/fig3.png", "   62 kB", ("current", "identical")),
        ("a/fig3.svg", "   46 kB", ("current", "differs")),
        ("b/fig4.png", "", (reason, "")),
        ("b/fig5.png", "", (reason, "")),
    ]
    print_files("", rows, HEADER, ["a note"])
    assert capsys.readouterr().out.splitlines() == [
        "",
        "a/",
        "figure  files                       state    as committed",
        "fig2    png   245 kB  svg 1,996 kB  current  identical",
        "fig3    png    62 kB                current  identical",
        "fig3    svg    46 kB                current  differs",
        "",
        "b/",
        "figure  files  state     as committed",
        "fig4    png    not made",
        "fig5    png    not made",
        f"b/fig4.png, b/fig5.png: {reason}",
        "a note",
    ]


def test_every_published_set_fits_into_80_columns(capsys):
    for each in committed_sets(config.load(ROOT / "config.yaml")):
        paths = [f"{each.folder}/{name}" for name in each.drawn]
        rows = [(path, "99,999 kB", ("not published", "not committed")) for path in paths]
        print_files("", rows, HEADER)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) >= 9 and max(map(len, lines)) <= 80


@pytest.mark.parametrize(
    ("variables", "coloured"), [({}, True), ({"NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)]
)
def test_verdicts_have_colours_at_a_terminal_alone(capsys, monkeypatch, variables, coloured):
    for name in ("NO_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    words = ["fig2  identical", "fig3  not made"]
    print_lines(words)
    assert capsys.readouterr().out.splitlines() == words
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    print_lines(words)
    if coloured:
        words = ["fig2  \033[32midentical\033[m", "fig3  \033[31mnot made\033[m"]
    assert capsys.readouterr().out.splitlines() == words
