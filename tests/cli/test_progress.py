"""The names of results, and the line of each step of a run."""

import logging

import pytest
from project import SHIPPED
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_reproduce as steps
from pipeline.cli.session import UsageError, one_line
from pipeline.config import build_specs, load
from pipeline.jobs import server
from pipeline.records.build_spec import BuildSpec

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


def spec(path, step, config=None):
    """Return the specification of a result of fig2."""
    return BuildSpec(path, "fig2", step, config or {}, "stage", None, [], [])


@pytest.fixture
def handler(tmp_path, monkeypatch):
    """A handler of the events of a run with two jobs: 0 makes orbits, and 1 draws them."""
    monkeypatch.chdir(tmp_path)
    specs = {ORBITS: spec(ORBITS, "orbits"), DRAWING: spec(DRAWING, "drawing png")}
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


def test_blocks_of_a_sweep_are_reported_as_cells(handler, capsys, monkeypatch):
    block = spec(ORBITS, "block 3", {"cells": [[0.2, 2.0]], "starts": 10, "impacts": 10})
    monkeypatch.setattr(steps, "plan", lambda: server.Plan({}, {ORBITS: block}, {ORBITS}))
    emit(handler, *begin(ORBITS), *end(0, 11.0, 1, 2))
    assert capsys.readouterr().err == "sweep: 1 of 1 cells\n"


def test_only_errors_of_the_given_kind_are_one_line():
    with pytest.raises(UsageError, match=r"^archive: no archive$"), one_line("archive: ", OSError):
        raise OSError("no archive")
    with pytest.raises(KeyError), one_line("archive: ", OSError):
        raise KeyError("a bug")
