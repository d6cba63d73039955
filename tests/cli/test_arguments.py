"""The command line: commands, names and the reports of mistakes, without a run."""

import os
import re
import sys
from contextlib import chdir
from importlib.metadata import version
from unittest.mock import patch

import pytest
from documents import complaint
from project import ROOT, run

from pipeline.cli import arguments
from pipeline.cli.main import main
from pipeline.config.validation import document
from pseudorigid.proofs import THEOREMS


def answer(capsys, *words):
    """Return the exit status, stdout and stderr of a command that makes nothing."""
    with chdir(ROOT), patch.dict(os.environ):
        try:
            status = main(list(words))
        except SystemExit as end:
            status = end.code
    return status, *capsys.readouterr()


def test_help_has_a_line_for_each_command(capsys):
    for words in (["--help"], ["-h"], ["help"], ["fig3", "--help"]):
        status, out, err = answer(capsys, *words)
        assert (status, err) == (0, "")
        for name, command in arguments.COMMANDS.items():
            assert re.search(rf"^  {name} +{re.escape(command.line)}$", out, re.MULTILINE)
    assert len(out.splitlines()) <= 41


def test_the_help_of_each_command_names_its_arguments(capsys):
    for name, command in arguments.COMMANDS.items():
        status, out, err = answer(capsys, name, "--help")
        assert (status, out, err) == answer(capsys, "help", name)
        assert (status, err) == (0, "")
        for argument, how in command.arguments:
            assert how.get("metavar", argument) in out
        assert ("goes to snakemake" in " ".join(out.split())) == command.runs_snakemake


def test_each_command_has_its_module_and_is_known_to_the_config():
    for name, command in arguments.COMMANDS.items():
        file = ROOT / "src/pipeline/cli/commands" / f"{command.module or name}.py"
        assert file.is_file() or name == "help"
    assert {*arguments.COMMANDS, "all"} == set(document.COMMANDS)


def test_theorems_are_named_like_their_certificates():
    assert all(theorem.certificate == f"{name}.toml" for name, theorem in THEOREMS.items())


def test_the_version_is_ours_and_snakemakes(capsys):
    status, out, _ = answer(capsys, "--version")
    assert status == 0
    assert re.fullmatch(rf"pseudorigid \S+, snakemake {version('snakemake')}\n", out)


FIGURES = "fig2, fig3, fig4, fig5, fig6, fig7 or fig8"
MISTAKES = {
    "verfy": ": no command or figure verfy: did you mean verify?",
    "fig33": ": no command or figure fig33: did you mean fig3?",
    "fig3 fgi5": ": no command or figure fgi5: did you mean fig5?",
    "fig2 fig3 list": ": list is a command, no figure: run ./reproduce list",
    "help verfy": ": no command verfy: did you mean verify?",
    "help verify fig3": " help: no argument fig3",
    "variant lower-energi": ": no variant lower-energi: did you mean lower-energy?",
    "variant lower-energy fig99": f": no figure fig99: did you mean {FIGURES}?",
    "compare paper douled fig2": ": no variant douled: did you mean doubled?",
    "sweep plan": ": no sweep plan: did you mean plane?",
    "sweep --version": " sweep: no argument --version: options of snakemake follow --",
    "list a=b": " list: no argument a=b",
    "verify --strikt": " verify: no argument --strikt: did you mean --strict?",
    "prove horsshoe-outer": ": no theorem horsshoe-outer: did you mean horseshoe-outer?",
    "prove --impact": " prove: no argument --impact: did you mean --impacts?",
    "claims --check 3 --data=x": ": claims: --check was removed: all claims are judged",
    "claims --data x": ": claims: --data was removed: the data of this tree are judged",
    "archive --machine aarch64": ": archive: --machine was removed: archive on such a machine",
    "report --against": " report: no argument --against: verify has it",
    "fig3 --slurm": ": no argument --slurm: sweep has it",
    "sweep --coers 1": " sweep: no argument --coers: did you mean --cores?",
    "fig3 --cores 0": ": argument -c/--cores: '0' is not allowed: expected 1 or more, or all",
    "-c0": ": argument -c/--cores: '0' is not allowed: expected 1 or more, or all",
    "report -c x": " report: argument -c/--cores: 'x' is not allowed: expected 1 or more, or all",
    "fig3 --dag": ": no argument --dag: options of snakemake follow --",
    "fig3 --foo": ": no argument --foo: options of snakemake follow --",
    "claims -j 5": " claims: no argument -j: options of snakemake follow --",
}


@pytest.mark.parametrize("line", MISTAKES)
def test_a_mistake_is_one_line_with_the_nearest_name(capsys, line):
    status, out, err = answer(capsys, *line.split())
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.partition(" config.yaml has ")[0].rstrip() == f"reproduce{MISTAKES[line]}"


def test_names_and_flags_may_be_mixed_and_options_of_snakemake_follow():
    args = arguments.read(["sweep", "--slurm", "line", "-c2", "small", "--", "-j", "5", "x"])
    assert (args.sweep, args.slurm, args.cores) == (["line", "small"], True, "2")
    assert (args.options, args.makes_nothing) == (["-j", "5", "x"], False)
    args = arguments.read(["claims", "--cores", "2", "-n"])
    assert (args.cores, args.options, args.makes_nothing) == ("2", [], True)
    assert arguments.read(["fig3", "--", "--dag"]).makes_nothing
    args = arguments.read(["test", "-k", "verify", "--help"])
    assert args.options == ["-k", "verify", "--help"]


def test_help_without_a_venv_installs_nothing(tree, tmp_path):
    before = sorted(tree.path.rglob("*"))
    (tmp_path / "python3").symlink_to(sys.executable)
    for words in ("help compare", "--help", "-h", "help"):
        environment = {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
        result = run(tree.path / "reproduce", *words.split(), env=environment, cwd="/")
        assert (result.returncode, result.stderr) == (0, ""), result
        assert result.stdout.startswith("usage: ./reproduce")
    assert sorted(tree.path.rglob("*")) == before


def test_no_scene_has_the_name_of_a_command():
    block = {"picture": "motion", "energy": 0.01, "period": 1, "type": "elliptic", "duration": 3}
    for key in ("scenes", "proofs"):
        given = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"fig3": block}, key: {"verify": block}}
        assert complaint(given).startswith(f"{key}: 'verify' is not allowed")
