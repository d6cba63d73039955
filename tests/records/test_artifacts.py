"""The data door: what goes in comes out, the same bytes every time, and nothing half-written."""

import os
import subprocess
import sys

import netCDF4
import numpy as np
import pytest
import xarray as xr
from content import content_hash
from project import ROOT

from pipeline.records import artifacts
from pipeline.records.artifacts import ArtifactError, load, save
from pipeline.records.files import FileError

CONFIG = {"starts": [0.5], "ball": {"k": 0.2, "g": 0.04}}
ABOUT = {"stage": "orbits", "k": 0.2, "g": 0.04, "energy": 0.01}


def saved(dataset, path, **attributes):
    """The path, where `dataset` is saved now."""
    save(dataset, path, CONFIG, **ABOUT, **attributes)
    return path


def variable(dims, values, **attrs):
    return dims, values, {"long_name": "something", "units": "1", "scale": "R"} | attrs


def dataset():
    return xr.Dataset(
        {
            "x": variable("point", np.array([0.1, np.nan, -0.0, 1e-310, np.inf])),
            "row_size": variable("orbit", np.array([2, 3], dtype=np.int32)),
            "stable": variable("orbit", np.array([0, 1], dtype=np.int8)),
            "type": ("orbit", ["elliptic", "inverse hyperbolic"], {"long_name": "stability"}),
            "window": variable((), 0.25),
        },
        attrs={"period": 6, "window_x": [0.21, 0.2116]},
    )


def test_round_trip_keeps_values_types_and_attributes(tmp_path):
    path = saved(dataset(), tmp_path / "deep" / "a.nc", resolution=1e-3)
    back = load(path)
    for name, before in dataset().variables.items():
        after = back[name]
        assert after.dims == before.dims
        if name == "type":
            assert after.values.tolist() == before.values.tolist()
        else:
            assert after.dtype == before.dtype
            assert after.values.tobytes() == before.values.tobytes()
        assert "_FillValue" not in after.attrs
    assert back.attrs["config"] == '{"ball":{"g":0.04,"k":0.2},"starts":[0.5]}'
    assert (back.attrs["stage"], back.attrs["k"], back.attrs["g"]) == ("orbits", 0.2, 0.04)
    assert (back.attrs["energy"], back.attrs["period"]) == (0.01, 6)
    assert back.attrs["resolution"] == 1e-3
    assert {name: back.attrs[name] for name in artifacts.ABOUT} == artifacts.ABOUT
    assert back.attrs["Conventions"] == "CF-1.11" and "Papadopoulos" in back.attrs["references"]
    assert back["row_size"].attrs["sample_dimension"] == "point"
    assert list(back.attrs["window_x"]) == [0.21, 0.2116]


def test_loaded_artifact_is_in_memory_and_its_file_closed(tmp_path):
    path = saved(dataset(), tmp_path / "a.nc")
    back = load(path)
    path.unlink()
    assert back["x"].values[0] == 0.1


def test_no_orbits_is_a_dataset_too(tmp_path):
    empty = xr.Dataset({"x": variable(("orbit", "point"), np.zeros((0, 6)))})
    assert load(saved(empty, tmp_path / "a.nc"))["x"].shape == (0, 6)


def test_same_bytes_whatever_the_process_and_the_order_of_variables(tmp_path):
    first = saved(dataset(), tmp_path / "a.nc").read_bytes()
    backwards = dataset()[sorted(dataset().variables, reverse=True)]
    backwards.attrs = dict(reversed(backwards.attrs.items()))
    assert saved(backwards, tmp_path / "b.nc").read_bytes() == first
    assert saved(load(tmp_path / "a.nc"), tmp_path / "c.nc").read_bytes() == first
    code = (
        "import sys; from test_artifacts import *; "
        "saved(dataset(), sys.argv[1]); "
        "print(content_hash(load(sys.argv[1])), end='')"
    )
    here = os.path.dirname(__file__)
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed, "TZ": "Asia/Tokyo"}
        environment["PYTHONPATH"] = os.pathsep.join([here, str(ROOT / "tests"), str(ROOT / "src")])
        path = tmp_path / f"{seed}.nc"
        run = subprocess.run(
            [sys.executable, "-c", code, path],
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stderr
        assert path.read_bytes() == first
        assert run.stdout == content_hash(load(tmp_path / "a.nc"))


@pytest.mark.parametrize(
    "change, words",
    [
        (lambda d: d["x"].attrs.pop("long_name"), "x has no long_name"),
        (lambda d: d["x"].attrs.update(units="m"), "x has units 'm'"),
        (lambda d: d["x"].attrs.pop("units"), "x has units None"),
        (lambda d: d["x"].attrs.pop("scale"), "x has no scale"),
        (lambda d: d.update({"x": variable("point", np.ones(5, bool))}), "x has dtype bool"),
        (lambda d: d.update({"row_size": variable("orbit", np.array([2, 2]))}), "adds up to 4"),
    ],
)
def test_refuses_what_is_incomplete(tmp_path, change, words):
    bad = dataset()
    change(bad)
    with pytest.raises(ArtifactError, match=words) as error:
        saved(bad, tmp_path / "a.nc")
    assert "a.nc" in str(error.value)
    assert not list(tmp_path.iterdir())


def test_a_failing_write_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = saved(dataset(), tmp_path / "a.nc")
    before = path.read_bytes()

    def half(dataset, part):
        part.write_bytes(b"half")
        raise OSError("disk full")

    monkeypatch.setattr(artifacts, "_write", half)
    with pytest.raises(FileError, match="cannot be written: disk full"):
        saved(dataset(), path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def damaged(tmp_path, kind):
    path = tmp_path / f"{kind}.nc"
    if kind == "missing":
        return path
    if kind == "foreign":
        with netCDF4.Dataset(path, "w") as file:
            file.title = "something else"
        return path
    whole = saved(dataset(), path).read_bytes()
    path.write_bytes({"empty": b"", "text": b"hello", "truncated": whole[: len(whole) // 2]}[kind])
    return path


@pytest.mark.parametrize("kind", ["missing", "empty", "text", "truncated", "foreign"])
def test_a_bad_file_gives_one_line_that_names_it(tmp_path, kind):
    path = damaged(tmp_path, kind)
    with pytest.raises(ArtifactError) as error:
        load(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_any_truncation_is_noticed(tmp_path):
    path = saved(dataset(), tmp_path / "a.nc")
    whole = path.read_bytes()
    for length in range(0, len(whole), len(whole) // 40):
        path.write_bytes(whole[:length])
        with pytest.raises(ArtifactError):
            load(path)


def test_content_hash_sees_content_and_only_content(tmp_path):
    before = load(saved(dataset(), tmp_path / "a.nc"))
    reference = content_hash(before)
    assert content_hash(before[sorted(before.variables, reverse=True)]) == reference
    swapped = before.assign(x=("point", before["x"].values.astype(">f8"), before["x"].attrs))
    assert content_hash(swapped) == reference
    changed = []
    for name, value in (("x", 0.1 + 2**-56), ("stable", 1)):
        other = before.copy(deep=True)
        other[name].values[0] = value
        changed.append(other)
    other = before.copy(deep=True)
    other["x"].values[2] = 0.0
    changed.append(other)
    changed.append(before.rename(x="y"))
    changed.append(before.rename(point="sample"))
    changed.append(before.assign_attrs(energy=0.02))
    changed.append(before.assign(stable=before["stable"].astype(np.int16)))
    other = before.copy(deep=True)
    other["x"].attrs["long_name"] = "another"
    changed.append(other)
    hashes = {content_hash(other) for other in changed}
    assert len(hashes) == len(changed)
    assert reference not in hashes


def test_importing_the_door_imports_no_stage():
    code = (
        "import sys, pipeline.records.artifacts;"
        "ours = ('pseudorigid', 'pipeline.', 'numba', 'matplotlib');"
        "print(*[m for m in sys.modules if m.startswith(ours)])"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    there = {"pipeline.records", "pipeline.records.artifacts", "pipeline.records.files"}
    there |= {"pseudorigid"}  # which loads modules from their text
    assert set(run.stdout.split()) == there, run.stderr
