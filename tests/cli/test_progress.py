"""A run is never silent for five seconds."""

import types
from itertools import pairwise

import pytest

from pipeline.jobs import heartbeat


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
