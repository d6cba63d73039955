"""How orbits are shared out to threads, counts of a map, and the lengths of verdicts."""

import os

import numpy as np
import pytest

from pseudorigid.dynamics import ensemble, verdict
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
def test_orbits_are_shared_out_to_threads_if_they_are_worth_it(
    monkeypatch, orbits, impacts, pieces
):
    """At least 32 orbits and 20,000 impacts for each of three threads."""
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    values, found = np.arange(orbits), []

    def work(a, b):
        assert np.array_equal(2 * a, b)
        found.append((a.size, a[0] if a.size else 0))
        b += 1
        return a.size

    doubled = 2 * values
    assert ensemble.in_threads(work, impacts, values, doubled) == orbits
    sizes = [size for size, _ in sorted(found, key=lambda piece: piece[1])]
    assert sizes == pieces and np.array_equal(doubled, 2 * values + 1)


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


def test_lengths_double_up_to_the_last_one():
    first = verdict.FIRST_LENGTH
    for impacts, lengths in (
        (first // 2, [first // 2]), (first, [first]), (first + 1, [first, first + 1]),
        (4 * first, [first, 2 * first, 4 * first]),
    ):  # fmt: skip
        assert verdict.lengths_to_decide(impacts) == lengths
