"""./reproduce prove checks what changed; --search replaces all certificates, or none."""

from types import SimpleNamespace

import pytest

from extensions import proofs
from extensions.proofs import command as prove
from extensions.proofs.command import CERTIFICATES
from helpers.project import fresh_tree, of_scenes
from pipeline.cli.errors import CommandLineError, UsageError
from pipeline.records import artifacts
from pseudorigid.verified.flight import NotProvedError

NAMES = ("fixed-point", "fixed-point-low")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of two certificates that are no certificates, in the place of this tree's."""
    monkeypatch.setattr(prove, "ROOT", tmp_path)
    folder = tmp_path / CERTIFICATES
    folder.mkdir(parents=True)
    for name in NAMES:
        (folder / f"{name}.toml").write_text("old")
    return folder


def search(monkeypatch, second=proofs.THEOREMS[NAMES[1]].text):
    """Search for both certificates; the second search is given."""
    searches = {NAMES[0]: proofs.THEOREMS[NAMES[0]].text, NAMES[1]: second}
    monkeypatch.setattr(proofs, "search_certificate", lambda name: searches[name]())
    prove.search(NAMES)


def fail(error):
    raise error


@pytest.mark.parametrize(("second", "error"), [
    (lambda: "not a certificate", UsageError),
    (lambda: fail(NotProvedError("no margin")), UsageError),
    (lambda: fail(KeyboardInterrupt()), KeyboardInterrupt),
])  # fmt: skip
def test_a_search_that_fails_leaves_all_certificates(folder, monkeypatch, second, error):
    with pytest.raises(error):
        search(monkeypatch, second)
    assert [file.read_text() for file in folder.iterdir()] == ["old", "old"]


def test_a_certificate_that_cannot_be_written_leaves_the_others(folder, monkeypatch):
    (folder / f"{NAMES[1]}.toml").unlink()
    (folder / f"{NAMES[1]}.toml").mkdir()
    with pytest.raises(ValueError, match=rf"{NAMES[1]}.toml: cannot be written"):
        search(monkeypatch)
    assert (folder / f"{NAMES[0]}.toml").read_text() == "old" and len(list(folder.iterdir())) == 2


def test_a_search_that_succeeds_replaces_them(folder, monkeypatch):
    search(monkeypatch)
    for name in NAMES:
        assert (folder / f"{name}.toml").read_text() == proofs.THEOREMS[name].text()


def steps(output):
    """Return the theorems that were checked, by the lines of the steps."""
    return {line.split()[0] for line in output.splitlines() if line.split()[1:2] == ["theorem"]}


def verdicts(output):
    """Return theorem -> verdict."""
    lines = [line for line in output.splitlines() if ".toml: " in line]
    return {line.partition(".toml")[0]: line.rpartition("; ")[2] for line in lines}


def edit(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


@pytest.mark.slow
def test_a_theorem_is_checked_again_if_its_certificate_or_the_code_changed(tmp_path):
    """Also without the scenes of the claims, and if its certificate is no proof."""
    tree = fresh_tree(tmp_path / "tree", of_scenes("fig3"))
    names = {"fixed-point", "one-fixed-point", "unstable"}
    proved = dict.fromkeys(names, "proved")
    assert "fixed-point: not made yet: theorem" in tree.succeed("prove", *names, "-n")
    first = tree.succeed("prove", *names)
    assert (steps(first), verdicts(first)) == (names, proved)
    again = tree.succeed("prove", *names)
    assert again.splitlines() == [line for line in again.splitlines() if ".toml: " in line]
    assert set(again.splitlines()) < set(first.splitlines())

    certificates = tree.path / CERTIFICATES
    edit(certificates / "unstable.toml", "margin = 5.6", "margin = 5.7")
    edit(certificates / "twist-six.toml", "points = [", "points = [[0, 0],")
    wrong = tree.run("prove", *names)
    assert (wrong.returncode, steps(wrong.stdout)) == (1, {"unstable"})
    assert verdicts(wrong.stdout) == proved | {"unstable": "not proved"}
    wrong = tree.run("prove", *names)  # a refusal is a result too
    assert (wrong.returncode, steps(wrong.stdout)) == (1, set())
    edit(certificates / "unstable.toml", "margin = 5.7", "margin = 5.6")

    tree.append("extensions/proofs/checkers/periodic.py")
    assert steps(tree.succeed("prove", "one-fixed-point", "unstable")) == names - {"fixed-point"}
    assert steps(tree.succeed("prove", "unstable", "--again")) == {"unstable"}
    (certificates / "unstable.toml").unlink()
    result = tree.run("prove")
    assert result.returncode == 1 and f"{CERTIFICATES}/unstable.toml was missing" in result.stdout


@pytest.mark.parametrize("options", ["again impacts", "makes_nothing search"])
def test_options_that_do_not_go_together_are_refused(options):
    """Of `./reproduce prove`; -n is called makes_nothing."""
    flags = ("search", "impacts", "pictures", "again", "makes_nothing")
    given = {flag: flag in options.split() for flag in flags}
    with pytest.raises(CommandLineError, match=r"^prove: "):
        prove.run(SimpleNamespace(theorem=[], **given))


@pytest.mark.parametrize(
    ("verdicts", "status"), [(("proved", "not proved"), 1), (("proved",) * 2, 0)]
)
def test_a_theorem_that_is_not_proved_is_the_exit_status(tmp_path, monkeypatch, verdicts, status):
    monkeypatch.setattr(prove, "ROOT", tmp_path)
    datasets = {("theorems", name, "theorem"): f"{name}.nc" for name in NAMES}
    made = dict(zip(datasets.values(), verdicts, strict=True))
    about = {tmp_path / file: {"line": file, "verdict": word} for file, word in made.items()}
    monkeypatch.setattr(artifacts, "load", lambda file: SimpleNamespace(attrs=about[file]))
    monkeypatch.setattr(prove.publishing, "make", lambda *given: 0)
    args = SimpleNamespace(search=False, again=False, makes_nothing=False, config=None)
    args.config = SimpleNamespace(datasets=datasets)
    assert prove._check(args, NAMES) == prove._check(args, NAMES[::-1]) == status
    monkeypatch.setattr(prove.publishing, "make", lambda *given: 3)
    assert prove._check(args, NAMES) == 3
