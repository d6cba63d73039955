"""How orbits are shared out to threads, and the counts of a map."""

import os

import numpy as np
import pytest

from pseudorigid.dynamics import ensemble
from pseudorigid.dynamics.ensemble import ImpactMap


@pytest.mark.parametrize(("setting", "threads"), [("3", 3), ("0", 1), ("1", 1)])
def test_threads_are_those_of_the_setting_or_of_the_cores(monkeypatch, setting, threads):
    monkeypatch.setenv("OMP_NUM_THREADS", setting)
    assert ensemble.threads() == threads
    for other in ("", "all"):
        monkeypatch.setenv("OMP_NUM_THREADS", other)
        assert ensemble.threads() == len(os.sched_getaffinity(0))


@pytest.mark.parametrize(("orbits", "impacts", "pieces"), [
    (63, 10**6, [63]), (64, 10**6, [32, 32]), (96, 10**6, [32, 32, 32]), (130, 10**6, [44, 43, 43]),
    (128, 311, [128]), (128, 313, [64, 64]), (0, 5, [0]),
])  # fmt: skip
def test_orbits_are_shared_out_to_threads_if_worth_it(monkeypatch, orbits, impacts, pieces):
    """At least 32 orbits and 20,000 impacts for each of three threads."""
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    values, found = np.arange(orbits), []

    def work(a, b):
        assert np.array_equal(a, b)
        found.append(a.tolist())
        return a.size

    assert ensemble.in_threads(work, impacts, values, values.copy()) == orbits
    assert [*map(len, sorted(found))] == pieces and np.array_equal(np.hstack(sorted(found)), values)


def test_a_map_counts_impacts_and_misses_and_is_equal_by_its_scan():
    certified, scan = ImpactMap(), ImpactMap((1, 0.5))
    for counted in (certified, scan):
        counted.count(10, 2)
        counted.count(5, 1)
        assert (counted.impacts, counted.missed) == (15, 3)
    assert certified.certified and not scan.certified
    assert scan == ImpactMap((1.0, 0.5)) != ImpactMap((1.0, 0.25)) and certified == ImpactMap()
    for bad in (3, (1.0,), (1.0, 0.0), (-1.0, 1.0), (1.0, np.inf)):
        with pytest.raises(ValueError, match="is not allowed"):
            ImpactMap(bad)
