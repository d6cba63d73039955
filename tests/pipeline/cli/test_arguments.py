"""The command line: commands, names and the reports of mistakes, without a run."""

import re
from importlib import metadata

import pytest
from hypothesis import given
from hypothesis import strategies as st

import pseudorigid
from helpers.commands import answer, mistake
from helpers.documents import complaint
from helpers.project import ROOT, path_of_bare_python, run
from helpers.random_documents import FUZZ
from pipeline.cli import arguments, main, packages
from pipeline.command_list import all_commands
from pipeline.config.schema.parts import SETS
from pipeline.declaration import parts


def test_help_has_a_line_for_each_command(capsys):
    files = ["fig3", "results/paper/orbits_fig2.nc"]
    files += ["study/edges", "edges"] if "study" in parts() else []
    for words in (["--help"], ["-h"], ["help"], *([name, "--help"] for name in files)):
        status, out, err = answer(capsys, *words)
        assert (status, err) == (0, "")
        for name, command in all_commands().items():
            assert re.search(rf"^  {name} +{re.escape(command.line)}$", out, re.MULTILINE)


def test_help_groups_the_commands(capsys):
    _, out, _ = answer(capsys, "help")
    groups = {block.partition(":\n")[0]: block for block in out.split("\n\n")}
    for name, command in all_commands().items():
        assert f"\n  {name} " in groups[command.group]


def test_list_shows_what_is_named(capsys):
    _, out, _ = answer(capsys, "list", "fig3")
    assert re.findall(r"^(\w+) +(?:png|svg|nc)", out, re.MULTILINE)[0] == "fig3"
    assert "orbits_fig3" not in out  # fig3 has the data of its periodic orbits alone
    assert not re.search("fig[24-8]|spread", out)


def test_help_needs_no_config(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(arguments, "ROOT", tmp_path)
    status, _, err = answer(capsys, "fig3", "--help")
    assert (status, err) == (2, "reproduce: no command or figure fig3\n")


MISTAKES = {
    "verfy": ": no command or figure verfy: did you mean verify?",
    "fig33 --help": ": no command or figure fig33",
    "results/paper/fig33.png --help": ": no command or figure results/paper/fig33.png",
    "verfy -h": ": no command or figure verfy: did you mean verify?",
    "fig3 fgi5": ": no command or figure fgi5: did you mean fig5?",
    "fig2 fig3 list": ": list is a command, no figure: run ./reproduce list",
    "fig2 below": ": below is a variant, no figure: run ./reproduce variant below",
    "help verfy": ": no command or figure verfy: did you mean verify?",
    "help verify fig3": " help: no argument fig3: usage: ./reproduce help [-h] [COMMAND]",
    "list fgi3": ": no figure, set or variant fgi3: did you mean fig3?",
    "zzz": ": no command or figure zzz: ./reproduce list shows the figures",
    "variant": ": variant needs a name:",
    "variant paper": ": no variant paper:",
    "variant lower-energi": ": no variant lower-energi: did you mean lower-energy?",
    "variant lower-energy fig99": ": no variant or figure fig99: did you mean fig2, fig3 or fig4?",
    "fig3 --strict": ": no argument --strict: verify has it",
    "variant --coers 1": " variant: no argument --coers: did you mean --cores?",
    "-c0": ": argument -c/--cores: '0' is not allowed: expected 1 or more, or all",
    "fig3 --dag": ": no argument --dag: options of snakemake follow --",
    "variant --version": " variant: no argument --version: options of snakemake follow --",
}


if "families" in parts():
    MISTAKES["energy"] = (
        ": energy is the name of several scenes: say study/energy or families/energy"
    )


@pytest.mark.parametrize("line", MISTAKES)
def test_a_mistake_is_one_line_with_the_nearest_name(capsys, line):
    assert mistake(capsys, line) == MISTAKES[line]


def test_names_and_flags_may_be_mixed_and_options_of_snakemake_follow():
    args = arguments.read(["variant", "low", "-c2", "fig3", "--", "-j", "5", "x"])
    assert (args.variant, args.cores) == (["low", "fig3"], "2")
    assert (args.options, args.makes_nothing) == (["-j", "5", "x"], False)
    args = arguments.read(["variant", "--cores", "2", "-n"])
    assert (args.cores, args.options, args.makes_nothing) == ("2", [], True)
    assert arguments.read(["fig3", "--", "--dag"]).makes_nothing
    args = arguments.read(["test", "-k", "verify", "--help"])
    assert args.options == ["-k", "verify", "--help"]


TYPED = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=8)
WORDS = [*all_commands(), "fig3", "fig2", "study/edges", "results/paper/orbits_fig2.nc", "=", "2"]
WORDS += [
    "-n",
    "-c",
    "-c2",
    "--cores",
    "--cores=all",
    "--strict",
    "-h",
    "--help",
    "--version",
    "--",
]


def test_any_command_line_is_read_or_refused_in_one_line(capsys):
    @FUZZ
    @given(words=st.lists(st.sampled_from(WORDS) | TYPED, max_size=4))
    def trial(words):
        status = None
        try:
            arguments.read(words)
        except SystemExit as end:
            status = end.code
        err = capsys.readouterr().err
        assert (status, err.count("\n")) in {(None, 0), (0, 0), (2, 1)}, (words, status, err)

    trial()


def test_help_without_a_venv_installs_nothing(tree, tmp_path):
    before = sorted(tree.path.rglob("*"))
    path = path_of_bare_python(tmp_path / "bin")
    for words in ("help verify", "--help", "-h", "help"):
        result = run(tree.path / "reproduce", *words.split(), env={"PATH": path}, cwd="/")
        assert (result.returncode, result.stderr) == (0, ""), result
        assert result.stdout.startswith("usage: ./reproduce")
    assert sorted(tree.path.rglob("*")) == before


def test_no_scene_has_the_name_of_a_command():
    block = {"picture": "motion", "energy": 0.01, "period": 1, "type": "elliptic", "duration": 3}
    for key in filter(None, (each.key for each in SETS.values())):
        given = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"fig3": block}, key: {"verify": block}}
        assert complaint(given).startswith(f"{key}: 'verify' is not allowed")


def test_a_command_of_a_part_that_is_not_there_says_which(capsys, monkeypatch):
    monkeypatch.setattr(arguments, "lacking", {"verify": "claims"}.get)
    assert mistake(capsys, "verify") == ": verify needs the part claims, which is not in src"


def test_the_help_of_a_command_has_its_arguments_and_a_required_name_no_brackets(capsys):
    for word, usage in (("verify", "[--strict]"), ("variant", "N] variant [variant ...]")):
        _, out, _ = answer(capsys, "help", word)
        assert out == answer(capsys, word, "--help")[1]
        assert out.startswith(f"usage: ./reproduce {word} ") and usage in " ".join(out.split())
    assert "[NAME]" not in out


def test_the_versions_are_the_projects_and_that_of_snakemake(capsys):
    snakemake = metadata.version("snakemake")
    line = f"pseudorigid {pseudorigid.__version__}, snakemake {snakemake}\n"
    assert answer(capsys, "--version") == (0, line, "")


@pytest.mark.parametrize(("words", "lists"), [
    ("fig3", []), ("list", []), ("test -q", ["test"]), ("prove -n", []), ("prove", ["algebra"]),
    ("fig3 -- --dag", []), ("fig3 -- --report", ["report"]), ("-- --report=a.html", ["report"]),
])  # fmt: skip
def test_a_command_installs_its_packages_unless_it_makes_nothing(monkeypatch, words, lists):
    if words.split()[0] not in {"fig3", "--", *all_commands()}:
        pytest.skip("starts from all parts")
    installed = []
    monkeypatch.setattr(packages, "add_packages", lambda *names: installed.extend(names))
    monkeypatch.setattr(main, "set_environment", lambda: None)
    monkeypatch.setattr(main, "imported", lambda name: lambda args: 0)
    monkeypatch.chdir(ROOT)
    assert (main.main(words.split()), installed) == (0, lists)
