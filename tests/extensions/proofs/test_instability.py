"""The instability at the resonance 1/4, by independent code, and certificates that are refused."""

import mpmath
import numpy as np
import pytest
from certificates import refused, with_field
from mpmath import mp, mpc, mpf
from sections import BALL

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import fixed_point, twist
from extensions.proofs.checkers.certificate import Certificate
from extensions.proofs.escape import escape

NAME = "unstable"
TEXT = THEOREMS[NAME].text()
LOW, HIGH = 21045268019740397, 21045268019740398  # the certificate's theta, times 1e16
ENERGY = 0.03739517136260749


def image(x, y, energy):
    """The next impact of (x, y), by eqs. (25) and (26); the flight time is near 4.2."""
    k, g = mpf(1) / 5, mpf(1) / 25
    s = mpmath.sqrt(((1 + k) * (2 * energy + 2 * g * x - k * x * x) - y * y) / k)
    v, w = (y + k * s) / (1 + k), (s - y) / (1 + k)
    b, c = ((1 - k) * v - 2 * k * w) / (1 + k), (-2 * v - (1 - k) * w) / (1 + k)

    def position(t):
        return x + b * t + g * t * t / 2

    t = mpmath.findroot(lambda t: position(t) - x * mpmath.cos(t) + c * mpmath.sin(t), 4.2)
    return position(t), b + g * t - k * (x * mpmath.sin(t) + c * mpmath.cos(t))


def fixed_point_at(energy):
    return mpmath.findroot(lambda x: image(x, mpf(0), energy)[0] - x, mpf("-0.2487"))


def derivative(part, x, energy, orders):
    """The partial derivative of one part of the image; the terms of order 0 are not used."""
    return mpmath.diff(lambda *z: image(*z, energy)[part], (x, mpf(0)), orders)


def trace(energy):
    x = fixed_point_at(energy)
    return derivative(0, x, energy, (1, 0)) + derivative(1, x, energy, (0, 1))


def test_independent_code_finds_the_energy_and_the_coefficients():
    """Numerical derivatives in 40 digits, and the normal form's coefficients in closed form."""
    with mp.workdps(40):
        energy = mpmath.findroot(trace, (mpf("0.0373"), mpf("0.0375")), tol=1e-25)
        x = fixed_point_at(energy)
        beta = mpmath.sqrt(derivative(0, x, energy, (0, 1)))  # sin(omega) = 1
        power, taylor = mpc(0, -1), {}
        for i in range(4):
            for j in range(4 - i):
                # (q, p) = (x/beta, beta y), and the coefficient of q^i p^j in the image's q + i p
                right, up = (derivative(part, x, energy, (i, j)) for part in (0, 1))
                scale = beta ** (i - j) / mpmath.factorial(i) / mpmath.factorial(j)
                taylor[i, j] = (right / beta + mpc(0, 1) * beta * up) * scale
        f = in_z(taylor)
        assert abs(f[1, 0] - power) < 1e-9 and abs(f[0, 1]) < 1e-9
        h = {(i, j): f[i, j] / (power**i * mpmath.conj(power) ** j - power)
             for i, j in ((2, 0), (1, 1), (0, 2))}  # fmt: skip
        bar = mpmath.conj
        a, b = (value / power for value in (
            2 * f[2, 0] * h[1, 1] + f[1, 1] * (h[2, 0] + bar(h[1, 1])) + 2 * f[0, 2] * bar(h[0, 2])
            + f[2, 1],
            f[1, 1] * h[0, 2] + 2 * f[0, 2] * bar(h[2, 0]) + f[0, 3],
        ))  # fmt: skip
        assert abs(a.real) < 1e-9
        found = {"energy": energy, "|A|": abs(a), "|B|": abs(b)}
    digits = THEOREMS[NAME].check().digits
    for name, value in found.items():
        assert float(digits[name].strip("[]").split()[0]) == pytest.approx(float(value), rel=1e-9)


def in_z(taylor):
    """The coefficients of z^i conj(z)^j, z = q + i p, of a series in q and p."""
    total = {(i, j): mpc(0) for i in range(4) for j in range(4 - i)}
    for (n, m), value in taylor.items():
        for i in range(n + 1):
            for j in range(m + 1):
                term = mpmath.binomial(n, i) * mpmath.binomial(m, j) * (-1) ** (m - j)
                total[i + j, n + m - i - j] += value * term / 2 ** (n + m) / mpc(0, 1) ** m
    return total


def theta(low, high):
    return f"theta = [{low}e-16, {high}e-16]"


CHANGES = {
    # |B| < |A| forged, and coefficients that are not those of this energy
    "coefficients = [7.35932691733, 1.74978423654]": "normal form is not",
    "coefficients = [1.74978423654, 7.359326919]": "normal form is not",
    "coefficients = [1.74978423654]": "no row of 2",
    # a margin that is not there, or too small
    "margin = 5.61": "not proved to be above |A| by 5.61",
    "margin = 5.59": "margin is 5.59, not 5.6",
    "margin = nan": "not an exact number",
    # bands that miss the resonance
    theta(LOW - 1, LOW): "hold the resonance",
    theta(HIGH, HIGH + 1): "hold the resonance",
    "theta = [1e-9, 2e-9]": "hold the resonance",
    # other bands that hold it
    theta(LOW - 10**5, HIGH): "statement's energies",
    "theta = [0.1, 2.9]": "",
    theta(LOW, LOW): "do not rise",
    "theta = [2.1, 3.2]": "do not rise",
    theta(LOW - 500, HIGH + 500): "normal form is not",  # too wide for the coefficients' digits
}  # fmt: skip


@pytest.mark.parametrize(("line", "reason"), CHANGES.items())
def test_altered_certificates_are_refused(line, reason):
    field, _, value = line.partition(" = ")
    text = with_field(TEXT, field, value)
    assert text != TEXT
    assert reason in refused(NAME, text)


def test_a_map_with_another_term_is_refused(monkeypatch):
    """|B| below |A|, and a map that does not keep area, in the computed form itself."""
    form = twist.resonant_coefficients
    monkeypatch.setattr(fixed_point, "resonant_coefficients", lambda *it: form(*it)[::-1])
    text = with_field(TEXT, "coefficients", "[7.35932691733, 1.74978423654]")
    assert "|B| is not proved to be above |A|" in refused(NAME, text)
    complex_map = twist.complex_map

    def drifting(*given, **more):
        power, map_ = complex_map(*given, **more)
        place = map_.algebra.monomials.index((2, 1))
        map_.coefficients[place] += power * 0.01
        return power, map_

    monkeypatch.setattr(fixed_point, "resonant_coefficients", form)
    monkeypatch.setattr(fixed_point, "complex_map", drifting)
    assert "does not keep area" in refused(NAME)


def test_the_statements_about_stability_fit_without_a_gap():
    """Both are about one energy with lambda^4 = 1, and the other exception has a second twist."""
    one_zero, zero = THEOREMS["twist-one-zero"], THEOREMS["twist-zero"]
    low, high = THEOREMS[NAME].bounds["energies"]
    assert one_zero.bounds["resonance"][0] <= low < high <= one_zero.bounds["resonance"][1]
    assert one_zero.bounds["energy"] > high
    begin, end = one_zero.bounds["zero"]
    band = Certificate(zero.text(), "zero of the twist")
    assert begin == band.number("energy") == end - band.number("width")
    assert all(theorem.bounds["k"] == one_zero.bounds["k"] for theorem in (zero, THEOREMS[NAME]))


def test_orbits_leave_at_the_resonance_and_stay_beside_it():
    data = escape(BALL, ENERGY, [0.0, 1e-5, 1e-4, 1e-3], 0.002, 64, 20_000)
    furthest = data["distance"].values[:, -1]
    assert furthest[0] > 1.5
    assert np.all(furthest[1:] < 0.006)
    assert np.all(np.diff(data["distance"].values, axis=1) >= 0)
