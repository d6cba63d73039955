"""Progress of a run: one line of a terminal; in a file a line a step, and one in 30 s at most."""

import logging
import types
from itertools import pairwise

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_reproduce as plugin
from pipeline.jobs import heartbeat


@pytest.fixture
def clock(monkeypatch):
    """A clock, in a list of one number."""
    now = [0.0]
    clock = types.SimpleNamespace(monotonic=lambda: now[0])
    monkeypatch.setattr(heartbeat, "time", clock)
    monkeypatch.setattr(plugin, "time", clock)
    monkeypatch.setattr(heartbeat.Heartbeat, "start", lambda self: None)
    return now


def beat(clock, until, describe):
    """Run a heartbeat up to a time, with a step that ends at 70 s."""
    heart, steps = heartbeat.Heartbeat(describe), [70.0]

    def wait(seconds):
        clock[0] += seconds
        if steps and clock[0] > steps[0]:
            heart.print(f"step {steps.pop():.0f}")
        return clock[0] > until

    heart.closed = types.SimpleNamespace(wait=wait)
    heart.run()


def test_a_file_gets_a_line_in_30_s_at_most(clock, capsys):
    times = [0.0]
    beat(clock, 300.0, lambda: times.append(clock[0]) or "running")
    gaps = [b - a for a, b in pairwise(times)]
    assert 30.0 <= min(gaps) < 30.5
    assert max(gaps) < 41.0  # after the step
    assert capsys.readouterr().err.count("\n") == len(times)  # with the step


def test_a_terminal_gets_one_line_no_wider_than_it(clock, capsys, monkeypatch):
    monkeypatch.setattr(heartbeat, "on_terminal", lambda: True)
    monkeypatch.setenv("COLUMNS", "20")
    beat(clock, 100.0, lambda: "running since ages and ages")
    line = heartbeat.CLEAR + "running since ages "
    assert capsys.readouterr().err.replace(line, "") == f"{heartbeat.CLEAR}step 70\n"


def event(name, **given):
    """Return an event as snakemake logs it."""
    return logging.makeLogRecord({"event": name, **given})


def test_the_line_has_the_share_of_earlier_seconds_and_the_time_left(clock, capsys, monkeypatch):
    seconds = {"results/paper/a.nc": 10.0, "results/paper/b.nc": 30.0}
    monkeypatch.setattr(plugin, "_expected", lambda: seconds)
    monkeypatch.setattr(plugin, "_names", lambda result: ("fig2", result[14]))
    monkeypatch.setattr(plugin.threading, "Thread", lambda **_: types.SimpleNamespace(start=int))
    handler = object.__new__(plugin.LogHandler)
    handler.__post_init__()
    handler.compiling = False
    handler.emit(event(LogEvent.RUN_INFO, stats={"stage": 2, "total": 2}))
    for job, result in enumerate(seconds):
        handler.emit(event(LogEvent.JOB_INFO, jobid=job, output=[result]))
        handler.emit(event(LogEvent.JOB_STARTED, jobs=[job]))
    clock[0] = 12.0  # a takes longer than before
    assert handler.describe() == "0 of 2, 55%: fig2 a (12 s), fig2 b (12 s)"
    clock[0] = 20.0  # twice as long
    handler.emit(event(LogEvent.JOB_FINISHED, job_id=0))
    handler.emit(event(LogEvent.PROGRESS, done=1, total=2))
    plugin.PROGRESS["results/paper/b.nc"] = "60%, halving"
    assert handler.describe() == "1 of 2, 75%, 20 s left: fig2 b (60%, halving, 20 s)"
    assert capsys.readouterr().err == "fig2    a              20.0 s   1 of 2\n"
