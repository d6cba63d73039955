"""docs/data.md is complete and up to date, and its lines run on a file as they stand."""

import shutil
import subprocess

import numpy as np
import xarray as xr
from test_documents import blocks, text_of

from pipeline.checks import datasets
from pipeline.config.schema.stages import STAGES
from pipeline.config.schema.study import FIXED, MEASURED
from pipeline.records import artifacts
from pseudorigid import Ball, lyapunov_spectrum, orbit, symmetric_orbits, trace_manifold
from pseudorigid.dynamics.orbits import scene_orbits

PAGE = "docs/data.md"


def test_the_page_is_that_of_the_datasets():
    """Of each stage, of sweeps and of the study, as their files are; every attribute has a text."""
    assert text_of(PAGE) == datasets.page(), "renew it: python -m pipeline.checks.datasets"
    assert list(datasets.SMALL) == list(STAGES)
    for name in (*STAGES, *(f"study: {part}" for part in (*FIXED, *MEASURED)), "derivations"):
        assert f"\n### {name}\n" in text_of(PAGE)


def saved(folder):
    """The file that the page speaks of, small."""
    found = scene_orbits(Ball(0.2, 0.04), 0.01, [0.1, -0.2, 0.6], [30, 20, 25])
    path = folder / "results" / "paper" / "orbits_fig2.nc"
    artifacts.save(found, path, {}, k=0.2, g=0.04, energy=0.01, title="orbits")
    return path


def test_its_lines_of_python_run(tmp_path, monkeypatch, capsys):
    path = saved(tmp_path)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks(PAGE):
        if not block.startswith("ncdump"):
            exec(block, names)
    said = capsys.readouterr().out
    assert "xdot:scale = omega R ;" in said and "time of flight" in said
    assert ":references = E. Kanso and P. Papadopoulos" in said
    assert names["second"]["x"].size == 20
    whole = artifacts.load(path)
    assert np.array_equal(names["second"]["x"], whole["x"][30:50])
    means = names["table"].groupby("orbit")["tau"].mean()
    assert np.allclose(means, [part.mean() for part in np.split(whole["tau"].values, [30, 50])])
    start = Ball(0.2, 0.04).start(-0.2, 0.01)
    assert np.array_equal(names["more"]["x"][:, 1], orbit(Ball(0.2, 0.04), start, 120)["x"][20:])


def test_its_lines_of_ncdump_run_where_it_is_installed(tmp_path):
    saved(tmp_path)
    (lines,) = (block for block in blocks(PAGE) if block.startswith("ncdump"))
    for line in lines.splitlines():
        assert line.startswith("ncdump -")
        if shutil.which("ncdump"):
            subprocess.run(["sh", "-c", line], cwd=tmp_path, check=True, capture_output=True)


def test_what_xarray_reads_is_what_the_door_reads(tmp_path):
    path = saved(tmp_path)
    with xr.open_dataset(path) as data:
        assert data.load().identical(artifacts.load(path))


def test_datasets_of_python_have_the_same_attributes():
    ball = Ball(0.2, 0.04)
    six = symmetric_orbits(ball, 0.01, 6)
    saddle = six.isel(orbit=1)
    start = ball.start([0.5], 0.01)
    found = [orbit(ball, start, 3), orbit(ball, start, 3, keep="last"), six, saddle]
    found += [lyapunov_spectrum(ball, start, 3), trace_manifold(ball, 0.01, saddle, length=0.1)]
    for data in found:
        for name, variable in data.variables.items():
            assert variable.attrs["long_name"], name
            if variable.dtype.kind != "O":
                assert variable.attrs["units"] == "1" and variable.attrs["scale"], name
    scales = {name: found[0][name].attrs["scale"] for name in ("x", "xdot", "udot", "tau")}
    assert scales == {"x": "R", "xdot": "omega R", "udot": "omega", "tau": "1/omega"}
