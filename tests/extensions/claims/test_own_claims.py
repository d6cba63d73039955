"""./reproduce claims with scenes of one's own, or without some that the verdicts need."""

from contextlib import nullcontext
from types import SimpleNamespace

import pytest
import yaml

from extensions.claims import command
from helpers.examples import example
from helpers.project import fresh_tree, of_scenes, shipped
from pipeline import config
from pipeline.cli.errors import UsageError

MINE = {"mine": yaml.safe_load(example("clusters"))}


@pytest.fixture
def made(monkeypatch):
    """The drawings and further data of each run of snakemake, of which there is none."""
    runs = []

    def make(config, targets, args, data=()):
        ((group, drawings),) = targets.items()
        runs.append((group, list(drawings), list(data)))
        return 0

    monkeypatch.setattr(command.publishing, "make", make)
    monkeypatch.setattr(command, "locked", nullcontext)
    monkeypatch.setattr(command, "write", lambda config: [SimpleNamespace(verdict="holds")])
    return runs


@pytest.mark.parametrize(("other", "lacking"), [
    ({"claims": MINE}, "clusters/clusters"),
    ({"sweeps": {}}, "atlas/line"),
    ({"variants": {}}, "as_published/fig7/lyapunov"),
])  # fmt: skip
def test_pictures_are_drawn_where_the_verdicts_lack_data(made, capsys, other, lacking):
    document = shipped() | other
    args = SimpleNamespace(config=config.check(document), makes_nothing=False)
    assert command.run(args) == 0
    drawn = [f"more_figures/claims/{name}.png" for name in document["claims"]]
    ((group, drawings, data),) = made
    assert (group, data) == ("claims", []) and {*drawn} <= {*drawings}
    words = f"CLAIMS.md stays as it is: no scene of config.yaml makes {lacking}, which claim "
    assert capsys.readouterr().out.strip().startswith(words)


def test_verdicts_are_written_where_nothing_lacks(made, capsys, monkeypatch):
    args = SimpleNamespace(config=config.check(shipped()), makes_nothing=False)
    monkeypatch.setenv("COLUMNS", "14")  # the width of the terminal
    assert command.run(args) == 0
    assert len(made[0][2]) > 50
    assert capsys.readouterr().out.strip() == "CLAIMS.md: 1\n  holds"


def test_without_pictures_and_verdicts_there_is_nothing_to_do(made):
    args = SimpleNamespace(config=config.check(of_scenes("fig3")), makes_nothing=False)
    with pytest.raises(UsageError, match="which claim"):
        command.run(args)
    assert made == []


@pytest.mark.slow
def test_own_scenes_are_drawn_and_published(tmp_path):
    tree = fresh_tree(tmp_path / "own", of_scenes("fig3", claims=MINE))
    assert "CLAIMS.md stays as it is" in tree.succeed("claims", "-n")
    said = tree.succeed("claims", "-c", "1")
    assert (tree.path / "more_figures/claims/mine.png").read_bytes().startswith(b"\x89PNG")
    assert "CLAIMS.md stays as it is: no scene of config.yaml makes " in said
    assert not (tree.path / "CLAIMS.md").exists()
