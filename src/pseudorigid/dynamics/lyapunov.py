"""The three Lyapunov exponents of an orbit, eq. (32) with the factor 1/i it lacks.

Benettin's method: an orthonormal frame is carried along by the analytic Jacobian, eq. (33), in the
same loop as the orbit, and made orthonormal again at each impact (Benettin et al. 1980, reference
[18] of the paper).
"""

import math

import numpy as np
import xarray as xr

from ..kernel.arithmetic import log
from ..kernel.compiled import jit
from ..kernel.impact import impact_coefficients, step_with_flight, tangent
from ..kernel.lanes import MIN_ORBITS_FOR_LANES
from ..kernel.tangents import CHUNK, GROUP, advance_chunk, allocate_buffers, push_tangent
from .ensemble import shared
from .inputs import not_allowed, state_of, whole_number
from .starts import start_state, start_variables
from .variables import attributes_of, orbit_dims


def lyapunov_spectrum(ball, state, impacts, records=400):
    """Lyapunov exponents an impact, and how they converge.

    Parameters
    ----------
    ball : Ball
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, as for `orbit`.
    impacts : int
        How many impacts, at least 1.
    records : int
        After how many equal stretches the exponents so far are kept, at least 1.

    Returns
    -------
    xarray.Dataset
        exponent, dims (impact, ..., index), nats an impact; its last entry is the final value.
        `index` counts the vectors of the frame, in the order in which they are orthogonalized. The
        values tend to falling order, but those of a finite orbit need not be in it: the largest
        exponent is `exponent.max("index")`. `impact` holds the number of impacts. A state of one
        dimension has the dim `orbit`, of more `orbit_0`, ... NaN from a grazing impact on, where
        the map has no derivative.

    Raises
    ------
    ValueError
        A state with xdot + udot < 0, impacts < 1 or records < 1.

    References
    ----------
    Kanso and Papadopoulos, eq. (32), with the factor 1/i that it lacks; Benettin, Galgani,
    Giorgilli and Strelcyn, Meccanica 15 (1980).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> lyapunov_spectrum(ball, ball.start(0.6, 0.01), 1000, 10)["exponent"].dims
    ('impact', 'index')
    """
    impacts = whole_number("impacts", impacts)
    records = min(whole_number("records", records), impacts)
    state = ball.on_section(*state_of(state))
    shape = state[0].shape
    dims = orbit_dims(shape)
    try:
        at = (np.arange(1, records + 1) * impacts) // records
        out = np.empty((state[0].size, records, 3))
    except (MemoryError, ValueError):
        raise not_allowed("records", records, "fewer: memory is short") from None

    def some(x, v, w, out):
        spectra = (
            _each if x.size < MIN_ORBITS_FOR_LANES else _spectrum
        )  # the second one takes long to compile
        return spectra(x, v, w, ball.k, ball.g, at, out, ball.map.root_finder)

    missed = shared(some, impacts, *(a.flatten() for a in state), out)
    ball.map.count(impacts * state[0].size, missed)
    exponent = (
        ("impact", *dims, "index"),
        np.ascontiguousarray(out.swapaxes(0, 1)).reshape(records, *shape, 3),
        attributes_of("Lyapunov exponent an impact, of each vector of the frame"),
    )
    attributes = attributes_of("number of impacts")
    return xr.Dataset({"exponent": exponent}, coords={"impact": ("impact", at, attributes)})


def scene_exponents(ball, energy, starts, impacts, records):
    """Lyapunov exponents of the orbits of a scene, and how they converge.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    starts : list
        Where its orbits start, each as in `starts.start_state`.
    impacts : int or list of int
        How many impacts of each; where they differ `exponent` is NaN at the records of others.
    records : int
        How many records of each orbit.

    Returns
    -------
    xarray.Dataset
        exponent (impact, orbit, index) as from `lyapunov_spectrum`; start on `orbit`, and start_x
        and start_xdot where a start is a point.

    Raises
    ------
    ValueError
        A start off the section, impacts < 1 or records < 1.

    References
    ----------
    Kanso and Papadopoulos, eq. (32), with the factor 1/i that it lacks, and Figure 7.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> found = scene_exponents(Ball(k=0.2, g=0.04), 0.01, [0.6], 1000, 10)
    >>> bool(abs(found["exponent"].values[-1].sum()) < 0.01)
    True
    """
    states = np.array([start_state(ball, energy, start) for start in starts])
    if isinstance(impacts, list) and len(set(impacts)) > 1:
        each = [
            lyapunov_spectrum(ball, state[:, None], count, records)
            for state, count in zip(states, impacts, strict=True)
        ]
        spectrum = xr.concat(each, "orbit", join="outer").transpose("impact", "orbit", "index")
    else:
        count = impacts[0] if isinstance(impacts, list) else impacts
        spectrum = lyapunov_spectrum(ball, tuple(states.T), count, records)
    return spectrum.assign(start_variables(starts, states))


@jit
def _unit(a, b, c):
    """A vector's length and its direction."""
    length = math.sqrt((a * a + b * b) + c * c)
    return length, a / length, b / length, c / length


@jit
def _without(a, b, c, d, e, f):
    """The vector (d, e, f) without its part along the unit vector (a, b, c)."""
    along = (a * d + b * e) + c * f
    return d - along * a, e - along * b, f - along * c


# Of each orbit its frame, three vectors, and the product of the lengths that each had; rows as in
# `tangents`.
_A, _B, _C, _GROWN, _SIZE = (3 * i * GROUP for i in range(5))


@jit
def _advance(frames, n, k, g, coefficients, states, flights, row):
    """Carry the frames of some orbits over an impact, and make them orthonormal.

    Their lengths are multiplied up. Returns whether one of these nears the end of what a double
    holds.
    """
    far = 0
    row = max(row, 0)  # where an index may be negative, no vector instructions come of a loop
    for i in range(n):
        a0, a1, a2 = frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i]
        b0, b1, b2 = frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i]
        c0, c1, c2 = frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i]
        at = row + i
        a0, a1, a2 = push_tangent(a0, a1, a2, k, g, coefficients, states, flights, at)
        b0, b1, b2 = push_tangent(b0, b1, b2, k, g, coefficients, states, flights, at)
        c0, c1, c2 = push_tangent(c0, c1, c2, k, g, coefficients, states, flights, at)
        p, a0, a1, a2 = _unit(a0, a1, a2)
        q, b0, b1, b2 = _unit(*_without(a0, a1, a2, b0, b1, b2))
        c0, c1, c2 = _without(a0, a1, a2, c0, c1, c2)
        r, c0, c1, c2 = _unit(*_without(b0, b1, b2, c0, c1, c2))
        p, q, r = (
            frames[_GROWN + i] * p,
            frames[_GROWN + GROUP + i] * q,
            frames[_GROWN + 2 * GROUP + i] * r,
        )
        frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i] = a0, a1, a2
        frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i] = b0, b1, b2
        frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i] = c0, c1, c2
        frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i] = p, q, r
        far += 0 if _held(p) & _held(q) & _held(r) else 1
    return far > 0


@jit
def _held(length):
    """Whether a length is far from the ends of what a double holds."""
    return (length > 1e-100) & (length < 1e100)


@jit
def _collect(total, frames, i):
    """Add the logarithms of the lengths of orbit i to its sums, and start again from 1."""
    for m in range(3):
        total[m, i] += log(frames[_GROWN + m * GROUP + i])
        frames[_GROWN + m * GROUP + i] = 1.0


@jit
def _spectrum(x, v, w, k, g, at, out, root_finder):
    """Exponents of the states (n,) after each of `at` (m,) impacts: out (n, m, 3).

    `root_finder` and what is returned, the impacts missed, are as in `impact`.
    """
    missed = 0
    for first in range(0, x.size, GROUP):
        group = slice(first, min(first + GROUP, x.size))
        missed += _group(x[group], v[group], w[group], k, g, at, out[group], root_finder)
    return missed


@jit
def _orthonormal(a, b, c):
    """Gram and Schmidt's method on three vectors: the three lengths, then the three directions."""
    p, a0, a1, a2 = _unit(*a)
    q, b0, b1, b2 = _unit(*_without(a0, a1, a2, *b))
    r, c0, c1, c2 = _unit(*_without(b0, b1, b2, *_without(a0, a1, a2, *c)))
    return p, q, r, (a0, a1, a2), (b0, b1, b2), (c0, c1, c2)


@jit
def _one(x, v, w, k, g, at, out, root_finder):
    """Write the exponents of one orbit after each of `at` impacts to out (m, 3).

    The frame stays in the processor's registers, which is faster for few orbits than `_group`.
    """
    coefficients = impact_coefficients(k)
    a, b, c = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    p = q = r = 1.0
    sums = np.zeros(3)
    missed, done = 0, 0
    for m in range(at.size):
        while done < at[m]:
            x, v, w, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                x, v, w, k, g, coefficients, root_finder
            )
            missed += late
            a = tangent(*a, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c)
            b = tangent(*b, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c)
            c = tangent(*c, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c)
            one, two, three, a, b, c = _orthonormal(a, b, c)
            p, q, r = p * one, q * two, r * three
            done += 1
            if done == at[m] or not (_held(p) & _held(q) & _held(r)):
                sums[0], sums[1], sums[2] = sums[0] + log(p), sums[1] + log(q), sums[2] + log(r)
                p = q = r = 1.0
        for j in range(3):
            out[m, j] = sums[j] / done
    return missed


@jit
def _each(x, v, w, k, g, at, out, root_finder):
    """Write the exponents of orbits, one after the other, to out (n, m, 3), as `_spectrum` does."""
    missed = 0
    for i in range(x.size):
        missed += _one(x[i], v[i], w[i], k, g, at, out[i], root_finder)
    return missed


@jit
def _group(x, v, w, k, g, at, out, root_finder):
    """Write the exponents of at most GROUP orbits after each of `at` impacts to out (n, m, 3)."""
    n = x.size
    missed, done = 0, 0
    if n < MIN_ORBITS_FOR_LANES:
        return _each(x, v, w, k, g, at, out, root_finder)
    coefficients = impact_coefficients(k)
    states, flights = allocate_buffers()
    frames, total = np.zeros(_SIZE), np.zeros((3, n))
    for i in range(n):
        frames[_A + i] = frames[_B + GROUP + i] = frames[_C + 2 * GROUP + i] = 1.0
        frames[_GROWN + i] = frames[_GROWN + GROUP + i] = frames[_GROWN + 2 * GROUP + i] = 1.0
    for m in range(at.size):
        while done < at[m]:
            impacts = min(CHUNK, at[m] - done)
            missed += advance_chunk(x, v, w, k, g, impacts, states, flights, root_finder)
            for row in range(0, impacts * GROUP, GROUP):
                if _advance(frames, n, k, g, coefficients, states, flights, row):
                    _collect_far(total, frames, n)
            done += impacts
        for i in range(n):
            _collect(total, frames, i)
            for j in range(3):
                out[i, m, j] = total[j, i] / done
    return missed


@jit
def _collect_far(total, frames, n):
    for i in range(n):
        p, q, r = frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i]
        if not (_held(p) and _held(q) and _held(r)):
            _collect(total, frames, i)
