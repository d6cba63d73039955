"""Cells on a graphics processor: with this machine in its place, and on a card if there is one."""

import hashlib
import json
import re
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from extensions.atlas.gpu import card, cells, orbit, plans
from extensions.atlas.starts import sunflower_points
from helpers.parts import host_card
from helpers.parts.host_card import HostCard
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.verdict import VERDICT, all_windows, classify_orbits, lengths_to_decide
from pseudorigid.kernel.arithmetic import log, sincos
from pseudorigid.kernel.formulas import start
from pseudorigid.kernel.impact import iterate
from pseudorigid.kernel.tangents import bump

PTX = Path(cells.__file__).with_name("kernel.ptx")


@pytest.fixture(params=["host", pytest.param("card", marks=pytest.mark.gpu)], scope="module")
def place(request):
    """Where cells are computed, and how large a test is there."""
    if request.param == "host":
        return HostCard(), 1
    try:
        return card.Card(PTX.read_bytes()), 64
    except card.CardError as error:
        if Path("/dev/nvidiactl").exists():
            raise
        pytest.skip(str(error))


def same(a, b):
    """Whether two arrays have the same bits, where any NaN is equal to any other."""
    a, b = (np.where(np.isnan(values), np.nan, values) for values in (a, b))
    return np.array_equal(a.astype(float).view(np.int64), b.astype(float).view(np.int64))


def test_elementary_functions(place):
    there, size = place
    random = np.random.default_rng(7)
    tiny = random.integers(0, 2**63, 1000 * size).view(float)
    values = np.concatenate([200.0 * random.random(1000 * size) - 100.0, tiny, -tiny, [0.0, -0.0]])
    found = there.empty(3 * values.size, float)
    there.run("elementary", values.size, values.size, there.copied(values), found)
    expected = np.array([(*sincos(value), log(value)) for value in values.tolist()]).T
    assert same(there.read(found, float), expected.ravel())


def test_orbits_at_their_own_k_g_and_energies(place):
    there, size = place
    random, count = np.random.default_rng(8), 128 * size
    k, g, energy = random.uniform([0.012, 0.05, 0.1], [0.33, 0.9, 40.0], (count, 3)).T
    g *= k
    states = start(k, g, energy * g * g, random.uniform(-0.99, 0.99, count))
    orbits = there.copied(np.array([*states, k, g]))
    there.run("advance", count, count, 2000, orbits)
    nothing = np.empty((1, 0, 4))
    for i, reached in enumerate(there.read(orbits, float).reshape(5, -1)[:3].T):
        x, v, w = (column[i : i + 1].copy() for column in states)
        iterate(x, v, w, k[i], g[i], 2000, np.zeros(1), nothing, None)
        assert same(reached, np.array([x, v, w])[:, 0])


@pytest.mark.slow
def test_verdicts_on_the_orbits_of_64_cells(place):
    """One of them has a fixed point that is not elliptic."""
    there, size = place
    starts, impacts = (20, 1700) if size == 1 else (200, 8000)
    low, high = [0.012, np.log(0.1)], [0.33, np.log(40.0)]
    drawn = np.random.default_rng(53).uniform(low, high, (64, 2))
    drawn[:, 1] = np.exp(drawn[:, 1])
    drawn[0] = 0.33, 40.0
    fixed = cells.fixed_points(drawn)
    assert np.isnan(fixed[0, 2])
    found = cells.classified(there, np.column_stack([drawn, fixed[:, [0, 2]]]), starts, impacts)
    for (k, e), numbers, mine in zip(
        drawn.tolist(), fixed, np.split(found, len(drawn)), strict=True
    ):
        assert same(numbers, np.array(fixed_point.numbers(k, e)))
        each = np.ones(starts)
        states = np.stack(sunflower_points(k, e, starts))
        theirs = classify_orbits(k, states, numbers[0] * each, numbers[2] * each, impacts)
        assert all(same(mine[name], theirs[name]) for name, *_ in VERDICT), (k, e)


def test_a_plan_opens_each_window_for_its_impacts_with_its_weights():
    impacts = 1300  # the last length is not twice the one before
    levels, shares, rows = plans.levels(impacts)
    turning, growing = all_windows(lengths_to_decide(impacts))
    seen = {row: {} for row in range(rows)}  # row -> impact -> weight
    for level in levels:
        (done, stop), at = level.plan[:2], orbit.HEADER
        while done < stop:
            end, turns, grows = level.plan[at : at + 3]
            for row, base in level.plan[at + 3 : at + 3 + 2 * turns].reshape(-1, 2):
                seen[row] |= {i: shares[base + i] for i in range(done, end)}
            at += 3 + 2 * turns + grows
            for row in level.plan[at - grows : at]:
                seen[row] |= dict.fromkeys(range(done, end), 1.0)
            done = end
        assert at == len(level.plan)
    for row, (first, length) in enumerate([*turning, *growing]):
        weights = bump(np.arange(length), length) if row < len(turning) else np.ones(length)
        assert seen[row] == dict(zip(range(first, first + length), weights, strict=True))


def test_an_orbit_that_a_thread_gave_up_is_never_judged(monkeypatch):
    monkeypatch.setattr(HostCard, "run", lambda *_: None)
    monkeypatch.setattr(HostCard, "empty", lambda _, *how: np.full(how[0], orbit.FAILED, how[1]))
    with pytest.raises(ArithmeticError, match="does not end"):
        cells.classified(HostCard(), np.array([[0.2, 1.0, 2.0, 0.2]]), 10, 1000)


def test_too_little_memory_is_said_in_one_line():
    small = HostCard()
    small.memory = 100_000_000
    with pytest.raises(card.CardError, match=r"0\.1 GB free, a cell of 400000 orbits takes 0\.1"):
        cells.orbits_at_once(small, 400_000, 8000)
    assert 200_000 < cells.orbits_at_once(small, 200, 8000) < 400_000


@pytest.mark.slow
def test_a_sweep_on_a_card_has_the_same_files_and_says_what_made_them(place, tmp_path):
    there, size = place
    project = pytest.importorskip("helpers.project")
    sweep = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 700, "block": 2}
    over = {"picture": "chains", "over": "small", "chains": [6]}  # it shares the dataset
    document = project.of_scenes("fig3", sweeps={"small": sweep, "over_it": over})
    tree = project.fresh_tree(tmp_path / "a fresh clone", document)
    folder = tree.path / "results/atlas"

    def made(*words):
        tree.succeed(*words)
        files = folder.glob("*.nc")
        return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}

    by_processor = made("sweep", "small")
    shutil.rmtree(folder)
    if size == 1:
        tree.command = lambda *words: [sys.executable, host_card.__file__, *words]
    assert made("sweep", "small", "--gpu") == by_processor
    on_card, tree = tree, project.Tree(tree.path)
    record = json.loads((folder / "provenance/sweep_small.0000.nc.json").read_text())
    assert (record["output"]["device"], record["output"]["driver"]) == (there.name, there.driver)
    assert tree.succeed("sweep", "small", "-n").strip() == "nothing to make"
    kernel = tree.path / PTX.relative_to(project.ROOT)
    kernel.write_text(kernel.read_text().replace("add.rn.f64", "sub.rn.f64", 1))
    assert "kernel.ptx differs" in tree.succeed("sweep", "small", "-n")
    refused = on_card.run("sweep", "small", "--gpu")
    assert refused.returncode == 1 and "not what the kernel gives" in refused.stdout


def test_arithmetic_on_a_card_is_rounded_once_and_calls_nothing_from_elsewhere():
    code = PTX.read_text()
    assert not re.search(
        r"\bfma|\.approx|\.ftz|\.extern|\bmad\.\S*f64|picklebuf|/", re.sub("//.*", "", code)
    )
    rounded = re.findall(r"\s((?:add|sub|mul|div|rcp|sqrt)\.\S*f64)\s", code)
    assert len(rounded) > 500 and all(each.split(".")[1] == "rn" for each in rounded)
    known = {"abs", "neg", "selp", "setp", "cvt", *(each.split(".")[0] for each in rounded)}
    assert {each.split(".")[0] for each in re.findall(r"\s([a-z]\S*\.f64)\s", code)} <= known
    called = {*re.findall(r"call.*?\), (\S+),", code)}
    assert called <= {*re.findall(r"\.func .*?\) (\S+)\(", code)}
    assert {*re.findall(r"\.entry (\w+)", code)} == {"classify", "advance", "elementary"}
