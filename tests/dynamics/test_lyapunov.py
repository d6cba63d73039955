"""Lyapunov exponents: an independent computation, known limits, history and bits."""

import numpy as np
import pytest
from cycles import SETTINGS
from sections import BALL

from pipeline.checks.compare import datasets
from pseudorigid import Ball, lyapunov_spectrum, orbit
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.figures.kinds import reports
from pseudorigid.kernel import spectrum


def final(state, impacts, **options):
    return lyapunov_spectrum(BALL, state, impacts, **options)["exponent"].values[-1]


def by_numpy(ball, state, impacts):
    """Return the exponents from numpy's QR decomposition and one Jacobian at a time."""
    path = orbit(ball, state, impacts)
    columns = [
        np.append(a, path[name][:-1]) for a, name in zip(state, ("x", "xdot", "udot"), strict=True)
    ]
    frame, total = np.eye(3), np.zeros(3)
    for jacobian in ball.jacobian(*columns):
        frame, r = np.linalg.qr(jacobian @ frame)
        total += np.log(np.abs(np.diag(r)))
    return total / impacts


@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS[::2])
def test_against_numpy_over_two_thousand_impacts(k, g, energy):
    ball = Ball(k, g)
    for start in (0.6, -0.3):
        state = ball.start(start, energy)
        exponents = lyapunov_spectrum(ball, state, 2000)["exponent"].values[-1]
        assert np.max(np.abs(exponents - by_numpy(ball, state, 2000))) < 1e-11


@pytest.mark.parametrize(
    ("impacts", "records"), [(1, 1), (7, 400), (1000, 7), (999, 400), (20_000, 1)]
)
def test_history_ends_with_the_final_value(impacts, records):
    """Over 20,000 impacts a vector grows beyond the range of doubles."""
    state = BALL.start(0.6, 0.01)
    found = lyapunov_spectrum(BALL, state, impacts, records)
    at = found["impact"].values
    assert at.dtype == np.int64
    assert (at.size, at[-1]) == (min(records, impacts), impacts)
    assert np.all(np.diff(at, prepend=0) > 0)
    full = lyapunov_spectrum(BALL, state, impacts, records=impacts)
    # Logarithms are summed in different groups, which changes roundings.
    expected = full["exponent"].values[at - 1]
    assert np.max(np.abs(found["exponent"].values - expected)) < 1e-13
    first = final(state, int(at[0]), records=1)
    assert np.max(np.abs(first - found["exponent"].values[0])) < 1e-13


def test_a_scene_has_a_history_for_each_start():
    starts = [0.6, 0.62]
    found = scene_exponents(BALL, 0.01, starts, 500, 5)
    assert dict(found["exponent"].sizes) == {"impact": 5, "orbit": 2, "index": 3}
    assert found["start"].values.tolist() == starts
    assert found["impact"].values.tolist() == [100, 200, 300, 400, 500]
    alone = lyapunov_spectrum(BALL, BALL.start(0.62, 0.01), 500, 5)["exponent"].values
    assert np.array_equal(alone, found["exponent"].values[:, 1])


def test_the_largest_exponent_is_the_largest_by_value():
    """After 100 impacts at this energy the exponents are not sorted by the order of the frame."""
    starts = np.linspace(-0.99, 0.99, 40).tolist()
    found = scene_exponents(BALL, 0.001, starts, 100, 4)
    last = found["exponent"].values[-1]
    assert np.any(last[:, 0] < last.max(axis=1))
    assert np.array_equal(final_exponents(found), np.sort(last, axis=1)[:, ::-1])

    block = {"energy": 0.001, "ball": {"k": 0.2, "g": 0.04}}
    numbers = reports.exponents(block, found)
    ours = [float(text) for text in numbers["largest exponent"].split(", ")]
    assert np.allclose(ours, np.sort(last.max(axis=1)), atol=5.1e-5)
    line = datasets.exponents(found, found, ("one", "other"))[1]
    assert line.split()[2] == f"{last.max(axis=1).mean():.4f}"


def test_few_orbits_do_not_compile_the_kernel_for_many(monkeypatch):
    monkeypatch.setattr(spectrum, "exponents_of_group", None)
    assert final(BALL.start([0.6, 0.62, 0.65], 0.01), 100).shape == (3, 3)
