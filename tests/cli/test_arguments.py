"""The command line: words, names and what is said of misspelt ones, without a run."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from project import ROOT

from pipeline.cli import arguments
from pipeline.config.validation import document


def answer(capsys, *words):
    """(exit status, stdout, stderr) of what is said before anything is installed."""
    try:
        status = arguments.main(list(words))
    except SystemExit as end:
        status = end.code
    return status, *capsys.readouterr()


def test_help_has_a_line_for_each_word(capsys):
    for words in (["--help"], ["-h"], ["help"], ["fig3", "--help"]):
        status, out, err = answer(capsys, *words)
        assert (status, err) == (0, "")
        for word, about in arguments.COMMANDS.items():
            assert re.search(rf"^  {word} +{re.escape(about.line)}$", out, re.MULTILINE)
    assert len(out.splitlines()) < 40


@pytest.mark.parametrize("word", arguments.COMMANDS)
def test_each_word_tells_its_arguments(capsys, word):
    told = [answer(capsys, word, "--help"), answer(capsys, "help", word)]
    assert told[0] == told[1]
    status, out, err = told[0]
    assert (status, err) == (0, "")
    about = arguments.COMMANDS[word]
    for name, how in about.arguments:
        assert how.get("metavar", name) in out
    assert ("goes to snakemake" in " ".join(out.split())) == about.passes


OLD = [f"python3.{minor}" for minor in range(6, 11)]
# The interpreters themselves, where pyenv has some: on PATH it has shims, which refuse.
PLACES = [*map(str, Path.home().glob(".pyenv/versions/*/bin")), os.environ["PATH"]]
ASK = "from pipeline.cli.arguments import main; import sys; sys.exit(main(sys.argv[1:]))"


@pytest.mark.parametrize("name", OLD)
def test_a_python_too_old_for_the_rest_answers_too(name):
    python = shutil.which(name, path=os.pathsep.join(PLACES))

    def ask(*words):
        command = [python, "-B", "-c", ASK, *words]
        where = os.environ | {"PYTHONPATH": str(ROOT / "src")}
        return subprocess.run(command, env=where, capture_output=True, text=True, check=False)

    if python is None or ask("--version").stderr.startswith("pyenv:"):
        pytest.skip(f"no {name} here")
    assert ask("--help").stdout.count("\n") < 40
    assert ask("fig33").stderr == "reproduce: no word or figure fig33: did you mean fig3?\n"
    going = ask("sweep", "plane", "-n")
    assert (going.returncode, going.stderr) == (arguments.VALID_SO_FAR, "")


@pytest.mark.parametrize("word", arguments.COMMANDS)
def test_each_word_has_its_module(word):
    name = arguments.COMMANDS[word].module or word
    found = (ROOT / "src/pipeline/cli/commands" / f"{name}.py").is_file()
    assert found or word == "help"


def test_theorems_are_called_as_their_certificates():
    from pseudorigid.proofs import THEOREMS

    assert all(theorem.certificate == f"{name}.toml" for name, theorem in THEOREMS.items())


def test_the_config_knows_the_words():
    assert {*arguments.COMMANDS, "all"} == set(document.COMMANDS)


def test_the_version_is_ours_and_snakemakes(capsys):
    from importlib.metadata import version

    status, out, _ = answer(capsys, "--version")
    assert status == 0
    assert re.fullmatch(rf"pseudorigid \S+, snakemake {version('snakemake')}\n", out)


FIGURES = "fig2, fig3, fig4, fig5, fig6, fig7 or fig8"
WRONG = {
    "verfy": "reproduce: no word or figure verfy: did you mean verify?",
    "fig33": "reproduce: no word or figure fig33: did you mean fig3?",
    "fig33 --strict": "reproduce: no word or figure fig33: did you mean fig3?",
    "fig3 fgi5": "reproduce: no word or figure fgi5: did you mean fig5?",
    "help verfy": "reproduce: no word verfy: did you mean verify?",
    "help verify fig3": "reproduce help: no argument fig3",
    "variant lower-energi": "reproduce: no variant lower-energi: did you mean lower-energy?",
    "variant lower-energy fig99": f"reproduce: no figure fig99: did you mean {FIGURES}?",
    "fig": f"reproduce: no word or figure fig: did you mean {FIGURES}?",
    "show --help": "reproduce: no word or figure show",
    "verfy -h": "reproduce: no word or figure verfy: did you mean verify?",
    "compare paper douled fig2": "reproduce: no variant douled: did you mean doubled?",
    "sweep plan": "reproduce: no sweep plan: did you mean plane?",
    "accept fig3": "reproduce accept: no argument fig3",
    "sweep --version": "reproduce sweep: no argument --version",
    "list a=b": "reproduce list: no argument a=b",
    "verify --strikt": "reproduce verify: no argument --strikt: did you mean --strict?",
    "prove horsshoe-outer": "reproduce: no theorem horsshoe-outer: did you mean horseshoe-outer?",
    "prove --impact": "reproduce prove: no argument --impact: did you mean --impacts?",
    "claims --check x": "reproduce claims: argument --check: invalid int value: 'x'",
    "sweep -n --config g=1": "reproduce: --config and --configfile are not used here: edit "
    "config.yaml",
    "clean --ye": "reproduce clean: no argument --ye: did you mean --yes?",
}


@pytest.mark.parametrize("line", WRONG)
def test_what_is_misspelt_is_one_line_with_the_nearest_name(capsys, line):
    assert answer(capsys, *line.split()) == (2, "", f"{WRONG[line]}\n")


@pytest.mark.parametrize(
    "line",
    [
        "",
        "fig3 fig5 --cores 2",
        "--cores 2",
        "-n",
        "paper_figures/fig3.png --dag",
        "horseshoe clusters",
        "all",
        "variant",
        "variant thin-shell fig4 -n",
        "compare paper doubled fig2 --cores 2",
        "sweep line --slurm -j 5",
        "claims --check 3 --data=x --cores 2",
        "clean --yes study gone",
        "test -x --no-such-option",
        "prove horseshoe-outer",
    ],
)
def test_what_may_be_right_goes_on(capsys, line):
    assert answer(capsys, *line.split()) == (arguments.VALID_SO_FAR, "", "")


def test_names_come_first_then_snakemakes_options_among_a_words_own():
    given = arguments.read(["sweep", "line", "-j", "5", "--slurm", "--forceall"])
    assert (given.sweep, given.slurm) == (["line"], True)
    assert given.options == ["-j", "5", "--forceall"]
    given = arguments.read(["claims", "--cores", "2", "--data", "f.nc", "--check=7"])
    assert (given.check, given.data, given.options) == (7, "f.nc", ["--cores", "2"])
    given = arguments.read(["test", "-k", "verify", "--help"])
    assert given.options == ["-k", "verify", "--help"]


@pytest.fixture
def bare(tmp_path):
    """What `reproduce` needs to answer, in a folder whose name has spaces and a colon."""
    folder = tmp_path / "a clone: here"
    shutil.copytree(ROOT / "src/pipeline", folder / "src/pipeline")
    (folder / "src/pseudorigid").mkdir()
    shutil.copy(ROOT / "src/pseudorigid/__init__.py", folder / "src/pseudorigid")
    shutil.rmtree(folder / "src/pipeline/__pycache__", ignore_errors=True)
    for cache in folder.rglob("__pycache__"):
        shutil.rmtree(cache)
    (folder / "requirements").mkdir()
    for name in ("reproduce", "config.yaml", "pyproject.toml", "requirements/lock.txt"):
        shutil.copy(ROOT / name, folder / name)
    shutil.copy(ROOT / "requirements/build.txt", folder / "requirements/build.txt")
    return folder


def test_without_a_venv_help_and_mistakes_make_nothing(bare, tmp_path):
    before = sorted(bare.rglob("*"))
    (tmp_path / "python3").symlink_to(sys.executable)
    path = f"{tmp_path}:{os.environ['PATH']}"
    for words, status in {
        "--help": 0,
        "help compare": 0,
        "verify --help": 0,
        "--version": 0,
        "verfy": 2,
        "fig33": 2,
        "variant fig3 --help": 0,
    }.items():
        said = subprocess.run(
            [str(bare / "reproduce"), *words.split()],
            env={"PATH": path},
            cwd="/",
            capture_output=True,
            text=True,
            check=False,
        )
        assert said.returncode == status, said
        assert (said.stdout == "") == (status == 2)
        assert len(said.stderr.splitlines()) == (status == 2)
    assert sorted(bare.rglob("*")) == before


def test_no_scene_is_named_like_a_word():
    block = {"picture": "motion", "energy": 0.01, "period": 1, "type": "elliptic", "duration": 3}
    for key in ("scenes", "proofs"):
        given = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"fig3": block}, key: {"verify": block}}
        with pytest.raises(document.ConfigError) as caught:
            document.check(given)
        allowed = "a name that is no command of ./reproduce"
        assert caught.value.lines == (f"{key}: 'verify' is not allowed: expected {allowed}",)
