"""Tables of files: one row for files that say the same, reasons below, colours at a terminal."""

import sys

import pytest

from pipeline.cli import table
from pipeline.cli.errors import UsageError, one_line
from pipeline.records.sources import ROOT

WHY = "not made: no such orbit"


def test_files_that_say_the_same_share_a_row_and_reasons_stand_below(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "1000")
    rows = [
        ("a/fig1.png", "12 kB", ("current", "differs")),
        ("a/fig1.svg", "3 kB", ("current", "differs")),
        ("a/fig2.png", "", (WHY, "")), ("b/fig3.png", "", (WHY, "")),
    ]  # fmt: skip
    table.print_files("run: ", rows, ("figure", "files", "state", "as committed"), ["a note"])
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    header = "figure files state as committed"
    assert lines == [
        "", "run: a/", header, "fig1 png 12 kB svg 3 kB current differs", "fig2 png not made",
        "", "run: b/", header, "fig3 png not made",
        "a/fig2.png, b/fig3.png: not made: no such orbit", "a note", table.WHAT_TO_DO,
    ]  # fmt: skip


def test_lines_are_wrapped_at_the_width_or_at_the_terminals(monkeypatch):
    text = "one two three"
    monkeypatch.delenv("COLUMNS", raising=False)
    assert table.wrapped(text) == [text] and table.wrapped(text, 8) == ["one two", "  three"]
    monkeypatch.setenv("COLUMNS", "5")
    assert table.wrapped(text, 8) == ["one", "  two", "  three"]
    monkeypatch.setenv("COLUMNS", "50")
    assert table.wrapped(text, 8) == ["one two", "  three"]


@pytest.mark.parametrize(("terminal", "setting", "coloured"), [
    (True, {}, True), (False, {}, False), (True, {"NO_COLOR": "1"}, False),
    (True, {"TERM": "dumb"}, False),
])  # fmt: skip
def test_verdicts_have_colours_at_a_terminal_alone(
    monkeypatch, capsys, terminal, setting, coloured
):
    for name in ("NO_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    for name, value in setting.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal)
    table.print_lines(["identical", "differs"])
    green, red = ("\033[32m", "\033[31m") if coloured else ("", "")
    end = "\033[m" if coloured else ""
    assert capsys.readouterr().out == f"{green}identical{end}\n{red}differs{end}\n"


def test_an_error_for_users_is_a_line_with_paths_below_the_root():
    with (
        pytest.raises(UsageError, match=r"^config\.yaml: a\.nc is bad$"),
        one_line("config.yaml: "),
    ):
        raise ValueError(f"{ROOT}/a.nc is bad")
    with pytest.raises(KeyError), one_line():
        raise KeyError("a bug")
