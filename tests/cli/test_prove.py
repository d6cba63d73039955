"""./reproduce prove --search replaces all certificates, or none."""

import pytest

from pipeline.cli import arguments
from pipeline.cli.commands import prove
from pipeline.cli.session import UsageError
from pseudorigid import proofs
from pseudorigid.proofs.enclosure.flight import NotProvedError

NAMES = ("fixed-point", "fixed-point-low")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of two certificates that are no certificates, in the place of this tree's."""
    monkeypatch.setattr(prove, "ROOT", tmp_path)
    folder = tmp_path / prove.CERTIFICATES
    folder.mkdir(parents=True)
    for name in NAMES:
        (folder / f"{name}.toml").write_text("old")
    return folder


def search(monkeypatch, second=proofs.THEOREMS[NAMES[1]].text):
    """Run the command, whose second search is given; return its status."""
    searches = {NAMES[0]: proofs.THEOREMS[NAMES[0]].text, NAMES[1]: second}
    monkeypatch.setattr(proofs, "search_certificate", lambda name: searches[name]())
    return prove.run(arguments.read(["prove", "--search", *NAMES]))


def fail(error):
    raise error


@pytest.mark.parametrize(
    ("second", "error"),
    [
        (lambda: "not a certificate", UsageError),
        (lambda: fail(ValueError("no such orbit")), UsageError),
        (lambda: fail(NotProvedError("no margin")), UsageError),
        (lambda: fail(KeyboardInterrupt()), KeyboardInterrupt),
        (lambda: fail(ModuleNotFoundError("scipy")), ModuleNotFoundError),
    ],
)
def test_a_search_that_fails_leaves_all_certificates(folder, monkeypatch, second, error):
    with pytest.raises(error):
        search(monkeypatch, second)
    assert [file.read_text() for file in folder.iterdir()] == ["old", "old"]


def test_a_certificate_that_cannot_be_written_leaves_the_others(folder, monkeypatch):
    (folder / f"{NAMES[1]}.toml").unlink()
    (folder / f"{NAMES[1]}.toml").mkdir()
    with pytest.raises(ValueError, match=rf"{NAMES[1]}.toml: cannot be written"):
        search(monkeypatch)
    assert (folder / f"{NAMES[0]}.toml").read_text() == "old"
    assert len(list(folder.iterdir())) == 2


def test_a_search_that_succeeds_replaces_them(folder, monkeypatch):
    assert search(monkeypatch) == 0
    for name in NAMES:
        assert (folder / f"{name}.toml").read_text() == proofs.THEOREMS[name].text()
