"""./reproduce claims reports the state of the pictures that it draws."""

from contextlib import nullcontext
from types import SimpleNamespace

import pytest

from pipeline.cli import claim_verdicts, figures, running
from pipeline.cli.commands import claims

DRAWING, DATA, PUBLISHED = "results/claims/a.png", "results/claims/a.nc", "more_figures/a.png"


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A folder in which `claims` draws one picture, without snakemake and without verdicts."""
    for file in (DRAWING, PUBLISHED):
        (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)

    def make(checked, freshness, targets, options):
        for target in targets:
            if not (tmp_path / target).is_file():
                (tmp_path / target).write_text("a picture")
        return 0

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(running, "make", make)
    fresh = SimpleNamespace(outdated=lambda paths: {}, refusal=lambda path: None)
    for module in (claims, figures):
        monkeypatch.setattr(module, "ROOT", tmp_path)
        monkeypatch.setattr(module, "Freshness", lambda *_: fresh)
    monkeypatch.setattr(claims.build_specs, "of_all", lambda checked: {})
    monkeypatch.setattr(claims.build_specs, "of_variants", lambda variants: {})
    monkeypatch.setattr(claims.paths, "figures", lambda *_: {PUBLISHED: ("a", [DATA, DRAWING])})
    monkeypatch.setattr(claims.paths, "artifact_paths", lambda variants: {})
    monkeypatch.setattr(claims, "locked", nullcontext)
    monkeypatch.setattr(claims, "interruptible", nullcontext)
    monkeypatch.setattr(figures.states, "committed", lambda folder, rows: {})
    monkeypatch.setattr(claim_verdicts, "dataset_paths", lambda checked: {"a": DATA})
    monkeypatch.setattr(claim_verdicts, "write", lambda checked: [])
    return tmp_path


def state(capsys):
    """Run the command, and return the state of the picture that it prints."""
    checked = {"variants": {"claims": {"a": {"picture": "portrait"}}}, "sweeps": {}}
    arguments = SimpleNamespace(check=None, data=None, checked=checked, options=[])
    assert claims.run(arguments) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if PUBLISHED in line]
    return line.split()[-1]


def test_a_picture_that_was_just_made_is_not_called_current(project, capsys):
    assert state(capsys) == "recomputed"
    assert (project / PUBLISHED).read_text() == "a picture"
    assert state(capsys) == "current"
    (project / DRAWING).unlink()
    assert state(capsys) == "recomputed"
