"""The names of results, and the line of each step of a run."""

import logging
import types
from itertools import pairwise

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_reproduce as steps
from pipeline.checks.freshness import Freshness
from pipeline.jobs import heartbeat, stage
from pipeline.jobs.plan import Plan
from pipeline.records.build_spec import BuildSpec

ORBITS, DRAWING = "results/paper/orbits_fig2.nc", "results/paper/figures/fig2.png"


def spec(path, step, config=None):
    """Return the specification of a result of fig2."""
    return BuildSpec(path, "fig2", step, config or {}, "stage", None, [], [])


@pytest.fixture
def handler(tmp_path, monkeypatch):
    """A handler of the events of a run with two jobs: 0 makes orbits, and 1 draws them."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(heartbeat.Heartbeat, "start", lambda self: None)
    specs = {ORBITS: spec(ORBITS, "orbits"), DRAWING: spec(DRAWING, "drawing png")}
    monkeypatch.setattr(steps, "plan", lambda: Plan({}, Freshness(tmp_path, specs), set()))
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


def test_silence_never_lasts_five_seconds(monkeypatch, capsys):
    now, times = [0.0], []
    monkeypatch.setattr(heartbeat.Heartbeat, "start", lambda self: None)

    def wait(seconds):
        now[0] += seconds
        if 7.0 < now[0] < 7.15 + seconds and len(times) == 1:  # a step ends
            times.append(now[0])
            heart.print("step")
        if now[0] > 60.0:
            raise KeyboardInterrupt

    clock = types.SimpleNamespace(monotonic=lambda: now[0], sleep=wait)
    monkeypatch.setattr(heartbeat, "time", clock)
    heart = heartbeat.Heartbeat(lambda: times.append(now[0]) or "running", waited=0.5)
    with pytest.raises(KeyboardInterrupt):
        heart.run()
    assert times[0] < 3.0
    assert max(b - a for a, b in pairwise(times)) < 5.0
    assert min(b - a for a, b in pairwise(times)) > 4.0
    assert capsys.readouterr().err.count("\n") == len(times) > 10


def test_a_long_stage_reports_the_share_done_every_four_seconds(monkeypatch, capsys):
    now = [100.0]
    monkeypatch.setattr(stage, "time", types.SimpleNamespace(monotonic=lambda: now[0]))
    progress = stage._progress(spec(ORBITS, "shares"))
    for done in range(100):
        progress(done / 100, f"{done} of 100 values")
        now[0] += 0.5
    lines = capsys.readouterr().err.splitlines()
    assert lines[:2] == ["fig2: 0%, 0 of 100 values", "fig2: 9%, 9 of 100 values"]
    assert len(lines) == 12


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
