"""Plans, the line of each step of a run, and the state of files."""

import hashlib
import json
import logging
import os

import pytest
from project import SHIPPED
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_reproduce as steps
from pipeline.checks import published_sets
from pipeline.checks.freshness import Freshness
from pipeline.cli.session import UsageError, one_line
from pipeline.config import build_specs, load
from pipeline.jobs import server
from pipeline.records.build_spec import BuildSpec
from pipeline.records.record import record_path, recorded

ORBITS, DRAWING = "results/paper/orbits_fig2.nc", "results/paper/figures/fig2.png"


def test_a_result_has_the_name_of_its_scene_and_step():
    checked = load(SHIPPED)
    checked["variants"]["thin"] = {"fig4": checked["scenes"]["fig4"] | {"energy": 0.011}}
    names = {path: (each.scene, each.step) for path, each in build_specs.of_all(checked).items()}
    assert names[ORBITS] == ("fig2", "orbits")
    assert names[DRAWING] == ("fig2", "drawing png")
    assert names["results/thin/figures/fig4.png"] == ("thin/fig4", "drawing png")
    assert names["results/claims/last_curve_last_curve.nc"] == ("last_curve", "last_curve")
    assert names["results/claims/derivations.nc"] == ("claims", "derivations")
    assert names["results/claims/theorem_six-elliptic.nc"] == ("six-elliptic", "theorem")
    assert names["results/sweep/plane_0012.nc"] == ("plane", "block 12")
    assert names["results/sweep/plane.nc"] == ("plane", "data")
    assert names["results/study/work.nc"] == ("work", "data")


def spec(path, step, config, sources, inputs=()):
    """Return the specification of a result of fig2."""
    config |= {"energy": 0.01}
    return BuildSpec(path, "fig2", step, config, "stage", None, sources, [*inputs])


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Return a folder with recorded orbits and a drawing of them, and their specifications."""
    monkeypatch.chdir(tmp_path)
    build_specs = {
        ORBITS: spec(ORBITS, "orbits", {"ball": {"g": 0.04}}, ["a.py", "b.py"]),
        DRAWING: spec(DRAWING, "drawing png", {"view": {"elevation": 40}}, ["b.py"], [ORBITS]),
    }
    for source in ("a.py", "b.py"):
        (tmp_path / source).write_text(source)
    for path, made in build_specs.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        with recorded(made):
            (tmp_path / path).write_text(path)
    return tmp_path, build_specs


def planned(made):
    return Freshness(*made).plan([ORBITS, DRAWING])


def test_a_plan_names_what_changed_by_scene(made):
    root, specs = made
    assert planned(made) == ["nothing to make"]

    def with_config(*paths, **fields):
        new = {path: specs[path]._replace(config=specs[path].config | fields) for path in paths}
        return root, specs | new

    changed = with_config(DRAWING, view={"elevation": 30})
    assert planned(changed) == ["fig2: view.elevation 40 -> 30: drawing"]
    changed = with_config(*specs, energy=0.008)
    words = "fig2: energy 0.01 -> 0.008: orbits, drawing"
    assert planned(changed) == [words]
    (root / "b.py").write_text("other")
    other = "made by other code than this tree's"
    assert planned(made) == [f"fig2: {other}: b.py differs: orbits, drawing"]
    (root / "a.py").write_text("other")
    both = f"{other}: a.py differs (and 1 more); {other}: b.py differs"
    assert planned(made) == [f"fig2: {both}: orbits, drawing"]


def test_a_plan_names_damaged_and_missing_results(made):
    root, _ = made
    path = root / record_path(DRAWING)
    record = json.loads(path.read_text())
    here, record["environment"]["numpy"] = record["environment"]["numpy"], "1.0"
    path.write_text(json.dumps(record))
    assert planned(made) == [f"fig2: made with numpy 1.0 then, {here} here: drawing"]
    (root / DRAWING).unlink()
    assert planned(made) == ["fig2: not made yet: drawing"]
    (root / ORBITS).write_text("other")
    assert planned(made) == ["fig2: changed after it was made: orbits, drawing"]
    (root / record_path(ORBITS)).write_text("{")
    assert planned(made)[0].startswith("fig2: its record results/paper/")
    for name in (record_path(ORBITS), ORBITS):
        (root / name).unlink()
    assert planned(made) == ["fig2: not made yet: orbits, drawing"]


def test_a_file_is_the_committed_one_by_its_bytes(tmp_path):
    (tmp_path / "figures").mkdir()
    for name in ("same.png", "other.png", "new.png"):
        (tmp_path / "figures" / name).write_text(name)
    digest = hashlib.sha256(b"same.png").hexdigest()
    lines = [f"{digest}  {name}.png\n" for name in ("same", "other", "gone")]
    (tmp_path / "figures" / "SHA256SUMS").write_text("".join(lines))
    for name, words in {
        "same": "identical to the committed one",
        "other": "differs from the committed one",
        "new": "not committed",
        "gone": "missing",
    }.items():
        assert published_sets.committed_state(tmp_path, f"figures/{name}.png") == words


@pytest.fixture
def handler(tmp_path, monkeypatch):
    """A handler of the events of a run with two jobs: 0 makes orbits, and 1 draws them."""
    monkeypatch.chdir(tmp_path)
    specs = {ORBITS: spec(ORBITS, "orbits", {}, []), DRAWING: spec(DRAWING, "drawing png", {}, [])}
    monkeypatch.setattr(steps, "plan", lambda: server.Plan({}, specs, set()))
    return steps.LogHandler(None, None)


def emit(handler, *events):
    """Send events to a handler: the kind, the time and what snakemake says about it."""
    for kind, created, about in events:
        record = logging.makeLogRecord({"msg": "", "created": created} | about)
        record.event = kind
        handler.emit(record)


def begin(*results):
    """Return the events of jobs that start at the same time."""
    jobs = [(LogEvent.JOB_INFO, 9.0, {"jobid": i, "output": [r]}) for i, r in enumerate(results)]
    return [*jobs, (LogEvent.JOB_STARTED, 10.0, {"jobs": [*range(len(results))]})]


def end(job, time, done, total=22):
    """Return the events at the end of a job."""
    progress = LogEvent.PROGRESS, time, {"done": done, "total": total}
    return (LogEvent.JOB_FINISHED, time, {"job_id": job}), progress


def test_a_step_is_a_line_with_its_seconds_and_the_count_of_steps(handler, capsys):
    emit(handler, *begin(ORBITS, DRAWING), (None, 10.5, {"msg": "Select jobs to execute..."}))
    emit(handler, *end(0, 11.06, 3), *end(1, 75.0, 4))
    err = capsys.readouterr().err.splitlines()
    assert [line.split() for line in err] == [
        ["fig2", "orbits", "1.1", "s", "3", "of", "22"],
        ["fig2", "drawing", "png", "65.0", "s", "4", "of", "22"],
    ]


def test_a_failing_step_is_one_line_with_its_reason(handler, capsys, tmp_path):
    log = tmp_path / "results/paper/logs/orbits_fig2.nc.log"
    log.parent.mkdir(parents=True)
    log.write_text("Traceback\n  ...\npseudorigid: fig2: the disk is full: 0.1 MB\n")
    message = {"msg": "In file x:\nCommand died with SIGKILL.\n  File y"}
    emit(handler, *begin(ORBITS, DRAWING), (LogEvent.ERROR, 9.0, message))
    emit(handler, *((LogEvent.JOB_ERROR, 9.0, {"jobid": job}) for job in range(2)))
    first, second = capsys.readouterr().err.splitlines()
    assert first.split(maxsplit=2)[2] == "not made: the disk is full: 0.1 MB"
    assert second.endswith("not made: Command died with SIGKILL.")
    assert handler.failed


def test_a_result_that_stays_as_it_was_has_no_seconds(handler, capsys, tmp_path):
    (tmp_path / DRAWING).parent.mkdir(parents=True)
    (tmp_path / DRAWING).touch()
    emit(handler, *begin(f"{DRAWING} (update)"))
    os.utime(tmp_path / DRAWING)
    emit(handler, *end(0, 11.0, 1, 2))
    assert "as it was" in capsys.readouterr().err


def test_only_errors_of_the_given_kind_are_one_line():
    with pytest.raises(UsageError, match=r"^archive: no archive$"), one_line("archive: ", OSError):
        raise OSError("no archive")
    with pytest.raises(KeyError), one_line("archive: ", OSError):
        raise KeyError("a bug")
