"""Sweeps: their config, their cells, and that no cut, order, fault or kill shows in the bytes."""

import copy
import hashlib
import io
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
import yaml
from conftest import ROOT, fresh_tree
from test_config import GOOD

from pipeline import config
from pipeline.cli import sweep_run as run
from pipeline.records import blocks as store
from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point, follow
from pseudorigid.sweep import cell, grid

SMALL = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}
RANGE = {"from": 0.1, "to": 10, "count": 3}


def check(**fields):
    document = copy.deepcopy(GOOD) | {"sweeps": {"a": SMALL | fields}}
    return config.check(document)["sweeps"]["a"]


# ---- config ----


def test_axes_are_the_decimals_they_are_meant_to_be():
    sweep = check(k={"from": 0.016, "to": 0.328, "count": 40}, energy=RANGE | {"spacing": "log"})
    assert sweep["k"][:4] == [0.016, 0.024, 0.032, 0.04]
    assert sweep["k"][23] == 0.2
    assert sweep["energy"] == [0.1, 1.0, 10.0]
    many = check(energy={"from": 0.1, "to": 40, "count": 40, "spacing": "log"})["energy"]
    assert many[1] == 0.116606
    assert many[-2] == 34.3037
    ratios = np.array(many[1:]) / np.array(many[:-1])
    assert ratios.max() / ratios.min() < 1 + 2e-5


def test_the_shipped_sweeps_hold_the_papers_cases():
    sweeps = config.load(ROOT / "config.yaml")["sweeps"]
    assert {0.625, 6.25} <= set(sweeps["line"]["energy"])
    assert sweeps["line"]["k"] == [0.2]
    assert grid.cells(sweeps["plane"]) == 1600


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"k": []}, ["sweeps.a.k: []", "at least one"]),
        ({"energy": RANGE | {"count": 1}}, ["sweeps.a.energy.count: 1", "from 2"]),
        ({"energy": RANGE | {"count": 0}}, ["sweeps.a.energy.count: 0", "from 2"]),
        ({"energy": RANGE | {"to": 0.1}}, ["sweeps.a.energy.to: 0.1", "above from = 0.1"]),
        ({"energy": RANGE | {"spacing": "lg"}}, ["sweeps.a.energy.spacing: 'lg'", "even or log"]),
        (
            {"energy": {"from": 0, "to": 1, "count": 3, "spacing": "log"}},
            ["sweeps.a.energy.from: 0", "> 0"],
        ),
        ({"energy": RANGE | {"cuont": 3}}, ["sweeps.a.energy.cuont", "did you mean count?"]),
        ({"energy": [2, 1]}, ["sweeps.a.energy: [2, 1]", "increasing"]),
        (
            {"energy": {"from": 1, "to": 1.00001, "count": 90, "spacing": "log"}},
            ["sweeps.a.energy: ", "differ in six digits"],
        ),
        ({"k": [0, 0.2]}, ["sweeps.a.k: 0", "0 < k <= 1"]),
        ({"k": [0.2, 1.5]}, ["sweeps.a.k: 1.5", "0 < k <= 1"]),
        ({"energy": [-2.5, 1]}, ["sweeps.a.energy: -2.5", "above -1/(2k) = -2.5"]),
        ({"energy": [1, 1e10]}, ["sweeps.a.energy: 10000000000.0", "at most 1e+09"]),
        ({"g": 0.1}, ["sweeps.a.g: 0.1", "0 < g < k = 0.1"]),
        ({"g": 0.04}, ["sweeps.a.energy: 6.25", "below (k/2 - g)/g^2 = 6.25"]),
        ({"starts": 0}, ["sweeps.a.starts: 0", "from 1"]),
        ({"impacts": 99}, ["sweeps.a.impacts: 99", "from 100"]),
        ({"block": 0}, ["sweeps.a.block: 0", "from 1"]),
        ({"stars": 3}, ["sweeps.a.stars", "did you mean starts?"]),
        ({"starts": 10**6, "impacts": 10**7}, ["sweeps.a.impacts: 10000000", "in a sweep"]),
        (
            {"energy": {"from": 1, "to": 9, "count": 10_000}},
            ["sweeps.a.block: 2", "at least 4 cells"],
        ),
    ],
)
def test_a_sweep_that_cannot_be_is_refused_in_one_line(fields, words):
    with pytest.raises(config.ConfigError) as caught:
        check(**fields)
    assert all(word in str(caught.value) for word in words), caught.value
    assert "\n" not in str(caught.value)


def test_sweeps_may_be_left_out():
    assert config.check(copy.deepcopy(GOOD))["sweeps"] == {}


def test_blocks_hold_each_cell_once_in_order():
    for size in (1, 2, 4, 5, 6, 100):
        sweep = SMALL | {"block": size}
        count = len(grid.block_files("a", sweep))
        cells = [pair for i in range(count) for pair in grid.block(sweep, i)["cells"]]
        assert cells == [[k, e] for k in SMALL["k"] for e in SMALL["energy"]]
        assert all(len(grid.block(sweep, i)["cells"]) <= size for i in range(count))


# ---- the fixed point ----


@pytest.mark.parametrize("k", [0.02, 0.2, 1 / 3, 1.0])
@pytest.mark.parametrize("e", [-0.4, 0.01, 0.625, 6.25, 40.0])
def test_the_closed_forms_are_those_of_the_map(k, e):
    theta = fixed_point.half_time(k, e)
    assert fixed_point.energy(k, theta) == pytest.approx(e, rel=1e-12, abs=1e-12)
    state = (fixed_point.place(k, theta), theta, theta / k)
    ball = Ball(k=k, g=1.0)
    assert ball.impact(*state) == pytest.approx((*state, 2 * theta), rel=1e-9, abs=1e-9)
    (a, _), (_, d) = ball.chart_jacobian(*state)
    assert fixed_point.trace(k, theta) == pytest.approx(a + d, rel=1e-8, abs=1e-8)


def test_the_trace_falls_with_the_energy():
    for k in (0.01, 0.2, 1.0):
        traces = [fixed_point.trace(k, t) for t in np.linspace(0.05, 3.1, 400)]
        assert np.all(np.diff(traces) < 0)


def test_the_rotation_number_and_its_resonances():
    assert fixed_point.rotation(0.0) == pytest.approx(0.25, abs=1e-15)
    assert fixed_point.rotation(-1.0) == pytest.approx(1 / 3, abs=1e-15)
    assert math.isnan(fixed_point.rotation(-2.1))
    for k, q in ((0.05, 8), (0.2, 6), (0.3, 3)):
        theta = fixed_point.half_time(k, fixed_point.resonance(k, 1, q))
        assert fixed_point.rotation(fixed_point.trace(k, theta)) == pytest.approx(1 / q, rel=1e-9)


# ---- a cell ----


def test_the_angle_is_that_of_the_vector():
    rng = np.random.default_rng(3)
    for a, b in [*rng.normal(size=(2000, 2)), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1)]:
        assert follow.angle(float(a), float(b)) == pytest.approx(math.atan2(b, a), abs=1e-14)
    assert follow.angle(0.0, 0.0) == 0.0


def test_starts_are_even_in_area_and_have_the_energy():
    k, e, count = 0.2, 6.25, 4000
    x, v, w = cell._even(k, e, count)
    assert Ball(k=k, g=1.0).energy(x, v, w) == pytest.approx(np.full(count, e))
    y = (v - k * w) / math.sqrt((1 + k) * (2 * e + 1 / k))
    x = (x - 1 / k) / math.sqrt((2 * e + 1 / k) / k)
    assert y.min() >= 0
    for left, width in ((-0.5, 0.5), (0.1, 0.3), (0.6, 0.2)):
        part = np.mean((x > left) & (x < left + width) & (y < 0.4))
        assert part == pytest.approx(width * 0.4 / (math.pi / 2), abs=6 / math.sqrt(count) / 10)


def test_wilsons_interval():
    assert cell.wilson(8, 10) == pytest.approx((0.4902, 0.9433), abs=1e-4)
    assert cell.wilson(0, 10) == pytest.approx((0.0, 0.2775), abs=1e-4)
    assert cell.wilson(10, 10) == pytest.approx((0.7225, 1.0), abs=1e-4)


def test_fractions_are_the_simplest_ones_nearby():
    turns, periods = cell.fractions(
        np.array([1 / 6, 1 / 6 + 2e-5, 2 / 12, 3 / 23, 0.0, 0.41421356])
    )
    assert periods.tolist() == [6, 0, 6, 23, 1, 0]
    assert turns.tolist() == [1, 0, 1, 3, 0, 0]


def test_the_papers_case_has_its_six_islands_and_its_sea():
    found = cell.cell(0.2, 6.25, 300, 4000)
    assert (found["chain_turns"], found["chain_period"]) == (1, 6)
    assert 0.14 < found["regular"] < 0.20
    assert found["regular_low"] < 0.17 < found["regular_high"]
    assert 0.215 < found["exponent"] < 0.25
    assert abs(found["regular_strict"] - found["regular_lenient"]) < 0.01
    assert found["trace"] == pytest.approx(0.8632851929828689, rel=1e-12)
    assert 1 / found["rotation"] == pytest.approx(5.5876195834, rel=1e-9)


def test_the_papers_small_energy_has_chains_of_ten_and_twelve():
    found = cell.cell(0.2, 0.625, 300, 4000)
    assert found["chains"][9] > 2
    assert found["chains"][11] > 2
    assert 0.64 < found["regular"] < 0.74


def test_nothing_is_chaotic_near_rest():
    found = cell.cell(0.2, -1.4, 40, 1000)
    assert found["regular"] == 1.0
    assert math.isnan(found["exponent"])
    found = cell.cell(0.2, -2.49999999, 20, 400)  # where the fixed point itself hardly turns
    assert found["rotation"] < 1e-4
    assert found["chain_period"] == 0


def test_the_exponent_is_that_of_the_spectrum():
    from pseudorigid import lyapunov_spectrum

    ball, energy = Ball(k=0.2, g=0.04), 0.01
    state = ball.start(0.6, energy)
    count = 20_000
    x, v, w = (np.full(3, value / ball.g) for value in state)
    x[1] += 1e-9
    x[2] += 2e-9
    growth, winding = np.empty(3), np.empty(3)
    weight = np.full(count, 1 / count)
    follow.follow(x, v, w, ball.k, 4.0, 0.17, weight, growth, winding)
    slow = lyapunov_spectrum(ball, state, count)["exponent"].values[-1, 0]
    assert growth.mean() == pytest.approx(slow, rel=0.1)


# ---- files ----


def make(folder, sweep, order=None):
    """Blocks and dataset of a sweep in `folder`; the dataset's path."""
    numbers = list(range(len(grid.ranges(sweep))))
    files = [(str(folder / f"{i}.nc"), grid.block(sweep, i)) for i in numbers]
    for i in order or numbers:
        path, block = files[i]
        store.save_block(store.compute(block), path, block)
    path = str(folder / "all.nc")
    store.join(grid.whole(sweep), files, path, path + ".sha256")
    return path


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def test_neither_cut_nor_order_shows_in_the_bytes(tmp_path):
    found = set()
    for size in (1, 2, 4, 6):
        sweep = SMALL | {"block": size}
        order = list(range(len(grid.ranges(sweep))))
        random.Random(size).shuffle(order)
        folder = tmp_path / str(size)
        folder.mkdir()
        path = make(folder, sweep, order)
        found.add(digest(path))
        assert store.intact(path, path + ".sha256")
    assert len(found) == 1


def test_the_dataset_opens_whole(tmp_path):
    path = make(tmp_path, SMALL)
    with xr.open_dataset(path) as data:
        assert dict(data.sizes) == {"k": 2, "energy": 3, "period": cell.PERIODS}
        assert set(data.data_vars) == set(cell.VARIABLES)
        one = cell.cell(0.2, 2.0, SMALL["starts"], SMALL["impacts"])
        here = data.sel(k=0.2, energy=2.0)
        for name, value in one.items():
            assert np.array_equal(here[name].values, value, equal_nan=True)


def test_a_damaged_block_is_named(tmp_path):
    block = grid.block(SMALL, 0)
    path = tmp_path / "block.nc"
    dataset = store.compute(block)
    store.save_block(dataset, path, block)
    content = path.read_bytes()
    store.load_block(path, block)
    flipped = bytearray(content)
    at = content.index(dataset["trace"].values.tobytes())
    flipped[at] ^= 1
    for damaged in (content[: len(content) // 2], b"", bytes(flipped)):
        path.write_bytes(damaged)
        with pytest.raises(store.StoreError, match=f"{path}: damaged"):
            store.load_block(path, block)
    path.write_bytes(content)
    with pytest.raises(store.StoreError, match="other cells"):
        store.load_block(path, block | {"impacts": 300})


def test_a_full_disk_leaves_one_line_and_no_file(tmp_path):
    block = grid.block(SMALL, 0)
    dataset = store.compute(block)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))
    try:
        with pytest.raises(store.StoreError) as caught:
            store.save_block(dataset, tmp_path / "block.nc", block)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert "block.nc: cannot be written" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert os.listdir(tmp_path) == []


def test_a_disk_that_is_too_full_is_told_before_anything_starts(monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=30_000_000))
    assert run.shortage({}, 0) is None
    assert run.shortage(dict.fromkeys(range(300)), 1000) is None
    line = run.shortage(dict.fromkeys(range(300)), 10_000)
    assert line == "the disk is full: about 34 MB are needed here, 30 are free"


# ---- the run ----


def test_names_come_before_options():
    sweeps = {"plane": SMALL, "line": SMALL}
    assert run.chosen(sweeps, []) == (["plane", "line"], [])
    assert run.chosen(sweeps, ["line", "-c", "1"]) == (["line"], ["-c", "1"])
    with pytest.raises(config.ConfigError, match="no such sweep: did you mean line"):
        run.chosen(sweeps, ["lime"])
    with pytest.raises(config.ConfigError, match="sweeps: missing, or empty"):
        run.chosen({}, [])


def test_progress_tells_rate_and_time_to_finish(tmp_path, monkeypatch):
    assert (
        run.line(10, (4, 400), (6, 600), 2.0) == "sweep: 4 of 10 cells, 2 cells/s, 0 min 3 s to go"
    )
    assert run.line(10, (4, 400), (0, 0), 2.0) == "sweep: 10 of 10 cells, 2 cells/s"
    assert run.line(10, (1, 100), (9, 1_000_000), 1.0).endswith("2 h 46 min to go")
    monkeypatch.setattr(run, "PAUSE", 0.01)
    out = io.StringIO()
    files = {str(tmp_path / name): (3, 30) for name in "ab"}
    with run.progress(files, 8, out):
        (tmp_path / "a").write_text("")
        time.sleep(0.1)
        (tmp_path / "b").write_text("")
    lines = out.getvalue().splitlines()
    assert [text.split(",")[0] for text in lines] == ["sweep: 5 of 8 cells", "sweep: 8 of 8 cells"]


@pytest.fixture
def sweeping(tmp_path):
    """A copy of the project with one small sweep."""
    tree = fresh_tree(tmp_path / "a fresh clone")
    set_sweep(tree, SMALL)
    return tree


def set_sweep(tree, sweep):
    path = tree.path / "config.yaml"
    document = yaml.safe_load(path.read_text()) | {"sweeps": {"small": sweep}}
    path.write_text(yaml.safe_dump(document, sort_keys=False))


def made(tree):
    """File -> (sha256, mtime) of the sweep's data."""
    folder = tree.path / "results" / "sweep"
    return {
        str(file.relative_to(folder)): (digest(file), file.stat().st_mtime_ns)
        for file in sorted(folder.rglob("*.nc"))
    }


def swept(tree, *words):
    result = tree.run("sweep", *words)
    assert result.returncode == 0, result.stdout
    return result.stdout


def test_faults_are_repaired_and_nothing_else_is_done_again(sweeping):
    out = swept(sweeping, "-c", "2")
    assert "sweep: 6 of 6 cells" in out
    before = made(sweeping)
    assert len(before) == 4
    swept(sweeping, "small", "-c", "1")
    assert made(sweeping) == before

    folder = sweeping.path / "results" / "sweep"
    hurt = folder / "blocks" / "small_0001.nc"
    hurt.write_bytes(hurt.read_bytes()[:3000])
    out = swept(sweeping, "-c", "1")
    assert "results/sweep/blocks/small_0001.nc: damaged" in out
    after = made(sweeping)
    assert {name: value[0] for name, value in after.items()} == {
        name: value[0] for name, value in before.items()
    }
    assert after["blocks/small_0000.nc"] == before["blocks/small_0000.nc"]
    assert after["blocks/small_0002.nc"] == before["blocks/small_0002.nc"]

    whole = folder / "small.nc"
    whole.write_bytes(whole.read_bytes()[:3000])
    assert "small.nc: not as it was written: joined again" in swept(sweeping, "-c", "1")
    assert made(sweeping)["small.nc"][0] == before["small.nc"][0]

    set_sweep(sweeping, SMALL | {"block": 4})
    swept(sweeping, "-c", "1")
    assert made(sweeping)["small.nc"][0] == before["small.nc"][0]


@pytest.mark.slow
def test_a_block_of_another_grid_is_never_mixed_in(sweeping):
    swept(sweeping, "-c", "1")
    set_sweep(sweeping, SMALL | {"energy": [0.3, 2.0, 7.0]})
    shutil.rmtree(sweeping.path / ".snakemake")  # its memory of parameters
    out = swept(sweeping, "-c", "1")
    assert "small_0001.nc: holds other cells" in out
    with xr.open_dataset(sweeping.path / "results/sweep/small.nc") as data:
        assert data["energy"].values.tolist() == [0.3, 2.0, 7.0]
        one = cell.cell(0.1, 7.0, SMALL["starts"], SMALL["impacts"])
        assert data.sel(k=0.1, energy=7.0)["exponent"] == one["exponent"]


@pytest.mark.slow
def test_a_killed_sweep_goes_on_to_the_same_bytes(sweeping):
    swept(sweeping, "-c", "1")
    wanted = {name: value[0] for name, value in made(sweeping).items()}
    folder = sweeping.path / "results" / "sweep"
    for file in (*folder.glob("blocks/*.nc"), folder / "small.nc"):
        file.unlink()
    process = subprocess.Popen(
        sweeping.command("sweep", "-c", "1"),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    while not list(folder.glob("blocks/*.nc")):
        assert process.poll() is None
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    present = made(sweeping)
    assert 0 < len(present) < 4
    assert all(wanted[name] == value[0] for name, value in present.items())
    swept(sweeping, "-c", "1")
    assert {name: value[0] for name, value in made(sweeping).items()} == wanted


def test_mistakes_end_in_one_line_before_any_job(sweeping):
    result = sweeping.run("sweep", "smal")
    assert result.returncode == 1
    assert result.stdout == "config.yaml: sweeps.smal: no such sweep: did you mean small?\n"
    set_sweep(sweeping, SMALL | {"energy": []})
    result = sweeping.run("sweep")
    assert result.returncode == 1
    assert result.stdout.startswith("config.yaml: sweeps.small.energy: [] is not allowed")
    assert not (sweeping.path / "results").exists()


def test_slurm_where_there_is_none_is_one_line(sweeping, monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    result = sweeping.run("sweep", "--slurm")
    assert result.returncode == 1
    assert result.stdout == "reproduce: --slurm: there is no sbatch on this machine\n"


@pytest.mark.slow
def test_the_atlas_is_drawn_and_published(sweeping):
    path = sweeping.path / "config.yaml"
    document = yaml.safe_load(path.read_text())
    document["sweeps"]["one"] = SMALL | {"k": [0.2], "g": 0.04, "block": 3}
    path.write_text(yaml.safe_dump(document, sort_keys=False))
    result = sweeping.run("atlas", "-c", "1")
    assert result.returncode == 0, result.stdout
    for name in ("small.png", "small.svg", "one.png", "one.svg"):
        drawn = (sweeping.path / "results/sweep/figures" / name).read_bytes()
        assert (sweeping.path / "atlas_figures" / name).read_bytes() == drawn
        assert drawn.startswith((b"\x89PNG", b"<?xml"))
    result = sweeping.run("atlas", "-c", "1")
    assert "Nothing to be done" in result.stdout


def test_the_papers_figures_need_no_sweep(sweeping):
    assert not [path for path in sweeping.planned() if "sweep" in path or "atlas" in path]


def test_the_start_imports_nothing_heavy():
    code = "import sys, pseudorigid.config, pseudorigid.sweep.run; print('numpy' in sys.modules)"
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment
    )
    assert result.stdout == "False\n"


CODE = """
from pseudorigid.artifacts import content_hash
from pseudorigid.sweep import store
block = {"cells": [[0.2, 6.25], [0.1, 0.3]], "starts": 20, "impacts": 2000}
print(content_hash(store.compute(block)))
"""


@pytest.mark.slow
def test_other_processors_give_the_same_bits(tmp_path):
    found = set()
    for extra in ({}, {"NUMBA_CPU_NAME": "generic", "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4"}):
        environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "PYTHONWARNINGS": "ignore"}
        environment |= extra | {"NUMBA_CACHE_DIR": str(tmp_path / str(len(extra)))}
        result = subprocess.run(
            [sys.executable, "-c", CODE],
            capture_output=True,
            text=True,
            env=environment,
            check=True,
        )
        found.add(result.stdout)
    assert len(found) == 1


def test_the_packages_for_slurm_are_pinned_hashed_and_those_of_the_lock():
    text = (ROOT / "requirements" / "slurm.txt").read_text()
    assert "://" not in text
    entries = re.split(r"^(?=[a-z0-9])", text, flags=re.MULTILINE)[1:]
    pins = dict(re.findall(r"^([\w.-]+)==([^\s;\\]+)", text, re.MULTILINE))
    lock = (ROOT / "requirements" / "lock.txt").read_text()
    locked = dict(re.findall(r"^([\w.-]+)==([^\s;\\]+)", lock, re.MULTILINE))
    assert "snakemake-executor-plugin-slurm" in pins
    assert len(entries) == len(pins)
    assert all("--hash=sha256:" in entry for entry in entries)
    assert all(version == locked.get(name, version) for name, version in pins.items())
