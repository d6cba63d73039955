"""Packages that a command adds to .venv: installed once, and again when their list has changed."""

import sys

import pytest

from pipeline.cli import lock, packages


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """The installations of a project in `tmp_path`, (name, whether again)."""
    calls = []
    (tmp_path / "requirements").mkdir()
    (tmp_path / "requirements/site.txt").write_text("a==1\n")
    (venv := tmp_path / ".venv").mkdir()
    for place, name, value in (
        (packages, "ROOT", tmp_path), (lock, "ROOT", tmp_path), (packages, "VENV", venv),
        (sys, "prefix", str(venv)),
    ):  # fmt: skip
        monkeypatch.setattr(place, name, value)
    monkeypatch.setattr(packages, "_install", lambda name, again: calls.append((name, again)))
    return calls


def test_packages_are_installed_once_and_again_for_another_list(installed, tmp_path, capsys):
    for listed in ("a==1\n", "a==1\n", "a==2\n", "a==2\n"):
        (tmp_path / "requirements/site.txt").write_text(listed)
        packages.add_packages("site")
    assert installed == [("site", False), ("site", True)]
    line = "reproduce: installing requirements/site.txt into .venv (once)\n"
    assert capsys.readouterr().err == 2 * line


def test_a_failed_installation_is_done_again(installed, monkeypatch):
    with monkeypatch.context() as patch, pytest.raises(ZeroDivisionError):
        patch.setattr(packages, "_install", lambda name, again: 1 / 0)
        packages.add_packages("site")
    packages.add_packages("site")
    assert installed == [("site", True)]


def test_an_environment_of_the_users_own_stays_as_it_is(installed, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "conda"))
    packages.add_packages("site")
    assert not installed and not [*(tmp_path / ".venv").iterdir()]
