"""The command line: commands, names and the reports of mistakes, without a run."""

import os
import re
import shutil
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from documents import complaint
from project import ROOT, run

from pipeline.cli import arguments
from pipeline.config.validation import document
from pseudorigid.proofs import THEOREMS


def answer(capsys, *words):
    """Return the exit status, stdout and stderr of the check before anything is installed."""
    try:
        status = arguments.main(list(words))
    except SystemExit as end:
        status = end.code
    return status, *capsys.readouterr()


def test_help_has_a_line_for_each_command(capsys):
    for words in (["--help"], ["-h"], ["help"], ["fig3", "--help"]):
        status, out, err = answer(capsys, *words)
        assert (status, err) == (0, "")
        for name, command in arguments.COMMANDS.items():
            assert re.search(rf"^  {name} +{re.escape(command.line)}$", out, re.MULTILINE)
    assert len(out.splitlines()) < 40


def test_the_help_of_each_command_names_its_arguments(capsys):
    for name, command in arguments.COMMANDS.items():
        status, out, err = answer(capsys, name, "--help")
        assert (status, out, err) == answer(capsys, "help", name)
        assert (status, err) == (0, "")
        for argument, how in command.arguments:
            assert how.get("metavar", argument) in out
        assert ("go to snakemake" in " ".join(out.split())) == command.runs_snakemake


def old_pythons():
    """Yield interpreters older than 3.11; pyenv's own folders come before its shims on PATH."""
    folders = [*map(str, Path.home().glob(".pyenv/versions/*/bin")), os.environ["PATH"]]
    for minor in range(6, 11):
        python = shutil.which(f"python3.{minor}", path=os.pathsep.join(folders))
        if python and run(python, "-V").returncode == 0:
            yield python


ASK = "from pipeline.cli.arguments import main; import sys; sys.exit(main(sys.argv[1:]))"


@pytest.mark.skipif(not any(old_pythons()), reason="no Python older than 3.11 here")
def test_the_oldest_python_answers_too():
    def ask(*words):
        environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
        return run(next(old_pythons()), "-B", "-c", ASK, *words, env=environment)

    assert ask("--help").stdout.count("\n") < 40
    assert ask("fig33").stderr == "reproduce: no command or figure fig33: did you mean fig3?\n"
    accepted = ask("sweep", "plane", "-n")
    assert (accepted.returncode, accepted.stderr) == (arguments.VALID_SO_FAR, "")


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
    assert re.match(rf"pseudorigid \S+, snakemake {version('snakemake')}\n", out)
    assert all(line.startswith("swh:1:dir:") for line in out.splitlines()[1:])


FIGURES = "fig2, fig3, fig4, fig5, fig6, fig7 or fig8"
MISTAKES = {
    "verfy": ": no command or figure verfy: did you mean verify?",
    "fig33": ": no command or figure fig33: did you mean fig3?",
    "fig33 --strict": ": no command or figure fig33: did you mean fig3?",
    "fig3 fgi5": ": no command or figure fgi5: did you mean fig5?",
    "help verfy": ": no command verfy: did you mean verify?",
    "help verify fig3": " help: no argument fig3",
    "variant lower-energi": ": no variant lower-energi: did you mean lower-energy?",
    "variant lower-energy fig99": f": no figure fig99: did you mean {FIGURES}?",
    "xyz --help": ": no command or figure xyz",
    "compare paper douled fig2": ": no variant douled: did you mean doubled?",
    "sweep plan": ": no sweep plan: did you mean plane?",
    "sweep --version": " sweep: no argument --version",
    "list a=b": " list: no argument a=b",
    "verify --strikt": " verify: no argument --strikt: did you mean --strict?",
    "prove horsshoe-outer": ": no theorem horsshoe-outer: did you mean horseshoe-outer?",
    "prove --impact": " prove: no argument --impact: did you mean --impacts?",
    "claims --check x": " claims: argument --check: invalid int value: 'x'",
    "sweep -n --config g=1": ": --config and --configfile are not used here: edit config.yaml",
}


@pytest.mark.parametrize("line", MISTAKES)
def test_a_mistake_is_one_line_with_the_nearest_name(capsys, line):
    assert answer(capsys, *line.split()) == (2, "", f"reproduce{MISTAKES[line]}\n")


RIGHT = """
fig3 fig5 --cores 2
-n
paper_figures/fig3.png --dag
horseshoe clusters
all
variant
variant thin-shell fig4 -n
compare paper doubled fig2 --cores 2
sweep line --slurm -j 5
claims --check 3 --data=x --cores 2
clean --yes study gone
test -x --no-such-option
prove horseshoe-outer"""


@pytest.mark.parametrize("line", RIGHT.split("\n"))
def test_a_line_that_may_be_right_goes_on(capsys, line):
    assert answer(capsys, *line.split()) == (arguments.VALID_SO_FAR, "", "")


def test_options_of_snakemake_may_stand_between_those_of_a_command():
    args = arguments.read(["sweep", "line", "-j", "5", "--slurm", "--forceall"])
    assert (args.sweep, args.slurm) == (["line"], True)
    assert args.options == ["-j", "5", "--forceall"]
    args = arguments.read(["claims", "--cores", "2", "--data", "f.nc", "--check=7"])
    assert (args.check, args.data, args.options) == (7, "f.nc", ["--cores", "2"])
    args = arguments.read(["test", "-k", "verify", "--help"])
    assert args.options == ["-k", "verify", "--help"]


def test_help_and_mistakes_without_a_venv_install_nothing(tree, tmp_path):
    before = sorted(tree.path.rglob("*"))
    (tmp_path / "python3").symlink_to(sys.executable)
    for words, status in {"help compare": 0, "--version": 0, "verfy": 2, "fig3 --help": 0}.items():
        environment = {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
        result = run(tree.path / "reproduce", *words.split(), env=environment, cwd="/")
        assert result.returncode == status, result
        assert (result.stdout == "") == (status == 2)
        assert len(result.stderr.splitlines()) == (status == 2)
    assert sorted(tree.path.rglob("*")) == before


def test_no_scene_has_the_name_of_a_command():
    block = {"picture": "motion", "energy": 0.01, "period": 1, "type": "elliptic", "duration": 3}
    for key in ("scenes", "proofs"):
        given = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"fig3": block}, key: {"verify": block}}
        assert complaint(given).startswith(f"{key}: 'verify' is not allowed")
