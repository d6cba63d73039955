"""Lyapunov exponents of orbits, eq. (32) with the factor 1/i that it lacks.

Benettin's method: the analytic Jacobian, eq. (33), carries an orthonormal frame of three vectors
along the orbit, and the frame is made orthonormal again at each impact (Benettin et al. 1980,
reference [18] of the paper). Kernels write the exponents after each of the impacts `at` (m,) to
`out` (m, 3) or (n, m, 3), and return how many impacts were missed, as in `kernel.impact`.
"""

import numpy as np
import xarray as xr

from ..kernel.arithmetic import log
from ..kernel.compiled import jit
from ..kernel.impact import impact_coefficients, step_with_flight
from ..kernel.lanes import MIN_ORBITS_FOR_LANES
from ..kernel.spectrum import in_range, orthonormal, push_frame, with_logarithms
from ..kernel.tangents import CHUNK, GROUP, advance_chunk, allocate_buffers, push_tangent
from .ball import Ball
from .ensemble import shared
from .inputs import not_allowed, state_of, whole_number
from .orbits import start_state, start_variables
from .variables import attributes_of, orbit_dims


def lyapunov_spectrum(ball: Ball, state, impacts: int, records: int = 400) -> xr.Dataset:
    """Compute the Lyapunov exponents, in nats an impact, and their convergence.

    Parameters
    ----------
    ball : Ball
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, as for `orbit`.
    impacts : int
        Number of impacts, at least 1.
    records : int
        Number of equal parts of the orbit after which the exponents so far are recorded, at least
        1.

    Returns
    -------
    xarray.Dataset
        exponent, dims (impact, ..., index); its last entry is the final value. `impact` holds the
        number of impacts. `index` counts the vectors of the frame in the order in which they are
        orthogonalized. The exponents tend to descending order, but need not be in it after a finite
        number of impacts: the largest one is `exponent.max("index")`. Arrays of states have the dim
        `orbit`, or orbit_0, orbit_1, ... From a grazing impact on, where the map has no derivative,
        exponents are NaN.

    Raises
    ------
    ValueError
        A state has xdot + udot < 0, or `impacts` or `records` is below 1.

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

    def piece(x, v, w, out):
        parts, compute = range(x.size), _one_orbit
        if x.size >= MIN_ORBITS_FOR_LANES:  # fewer are not worth the time to compile `_group`
            parts = [slice(i, i + GROUP) for i in range(0, x.size, GROUP)]
            compute = _group
        k, g, scan = ball.k, ball.g, ball.map.scan
        return sum(compute(x[i], v[i], w[i], k, g, at, out[i], scan) for i in parts)

    missed = shared(piece, impacts, *(a.flatten() for a in state), out)
    ball.map.count(impacts * state[0].size, missed)
    exponent = (
        ("impact", *dims, "index"),
        np.ascontiguousarray(out.swapaxes(0, 1)).reshape(records, *shape, 3),
        attributes_of("Lyapunov exponent an impact, of each vector of the frame"),
    )
    attributes = attributes_of("number of impacts")
    return xr.Dataset({"exponent": exponent}, coords={"impact": ("impact", at, attributes)})


def scene_exponents(
    ball: Ball, energy: float, starts: list, impacts: int | list[int], records: int
) -> xr.Dataset:
    """Compute the Lyapunov exponents of the orbits of a scene, and their convergence (Figure 7).

    Starts are as in `orbits.start_state`. `impacts` is the number of all orbits, or a list; at the
    records of other orbits `exponent`, as from `lyapunov_spectrum`, is NaN.

    >>> from pseudorigid import Ball
    >>> spectrum = scene_exponents(Ball(k=0.2, g=0.04), 0.01, [0.6], 1000, 10)
    >>> bool(abs(spectrum["exponent"].values[-1].sum()) < 0.01)
    True
    """
    states = np.array([start_state(ball, energy, start) for start in starts])
    counts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    if len(set(counts)) > 1:
        spectra = [
            lyapunov_spectrum(ball, state[:, None], count, records)
            for state, count in zip(states, counts, strict=True)
        ]
        spectrum = xr.concat(spectra, "orbit", join="outer").transpose("impact", "orbit", "index")
    else:
        spectrum = lyapunov_spectrum(ball, tuple(states.T), counts[0], records)
    return spectrum.assign(start_variables(starts, states))


# Offsets of each orbit's frame, three vectors, and the products of their lengths; rows as in
# `tangents`.
_A, _B, _C, _GROWN, _SIZE = (3 * i * GROUP for i in range(5))


@jit
def _advance(frames, n, k, g, coefficients, states, flights, row):
    """Carry the frames of n orbits over an impact, and make them orthonormal.

    Return whether one of the products of lengths nears the limits of a double.
    """
    extremes = 0
    row = max(row, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        at = row + i
        a0, a1, a2 = frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i]
        b0, b1, b2 = frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i]
        c0, c1, c2 = frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i]
        p0, q0, r0 = frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i]
        p, q, r, a, b, c = orthonormal(
            push_tangent(a0, a1, a2, k, g, coefficients, states, flights, at),
            push_tangent(b0, b1, b2, k, g, coefficients, states, flights, at),
            push_tangent(c0, c1, c2, k, g, coefficients, states, flights, at),
        )
        a0, a1, a2 = a
        b0, b1, b2 = b
        c0, c1, c2 = c
        p, q, r = p0 * p, q0 * q, r0 * r
        frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i] = a0, a1, a2
        frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i] = b0, b1, b2
        frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i] = c0, c1, c2
        frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i] = p, q, r
        extremes += 0 if in_range(p) & in_range(q) & in_range(r) else 1
    return extremes > 0


@jit
def _one_orbit(x, v, w, k, g, at, out, root_finder):
    """Compute the exponents of one orbit; its frame stays in the processor's registers."""
    coefficients = impact_coefficients(k)
    a, b, c = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    sums, lengths = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    missed, done = 0, 0
    for m in range(at.size):
        while done < at[m]:
            x, v, w, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                x, v, w, k, g, coefficients, root_finder
            )
            a, b, c, lengths, sums = push_frame(
                a, b, c, lengths, sums, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c
            )
            missed += late
            done += 1
        sums, lengths = with_logarithms(sums, lengths), (1.0, 1.0, 1.0)
        for j in range(3):
            out[m, j] = sums[j] / done
    return missed


@jit
def _group(x, v, w, k, g, at, out, root_finder):
    """Compute the exponents of at most GROUP orbits."""
    n = x.size
    missed, done = 0, 0
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
                    _collect(total, frames, n, False)
            done += impacts
        _collect(total, frames, n, True)
        for i in range(n):
            for j in range(3):
                out[i, m, j] = total[j, i] / done
    return missed


@jit
def _collect(total, frames, n, every):
    """Add the logarithms of lengths to the sums of every orbit, or of those with an extreme one."""
    for i in range(n):
        p, q, r = frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i]
        if every or not (in_range(p) and in_range(q) and in_range(r)):
            for m in range(3):
                total[m, i] += log(frames[_GROWN + m * GROUP + i])
                frames[_GROWN + m * GROUP + i] = 1.0
