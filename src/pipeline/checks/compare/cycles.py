"""Which periodic orbits of two artifacts belong together: kept, changed in type, lost, gained."""

import numpy as np

from pseudorigid.dynamics.ball import Ball

REACH = 0.25  # section radii: farther apart two orbits are told as one lost and one gained


def table(one, other, names):
    """Lines on the orbits of two artifacts of stage periodic.

    Orbits of one period are matched, the nearest first, in the section scaled to a unit disk.
    """
    periods = [data.attrs["period"] for data in (one, other)]
    if periods[0] != periods[1]:
        both = zip(names, periods, (one, other), strict=True)
        return [f"{name}: period {period}: {_listed(data)}" for name, period, data in both]
    head = f"period {periods[0]}"
    lines = []
    matches, lost, gained = match(one, other)
    for i, j, distance in matches:
        before, after = _words(one, i), _words(other, j)
        kinds = [str(data["type"].values[at]) for data, at in ((one, i), (other, j))]
        verb = "kept" if kinds[0] == kinds[1] else "changed in type"
        lines.append(f"{head}: {verb}: {before} | {after}, moved {distance:.3g}")
    lines += [f"{head}: lost: {_words(one, i)}" for i in lost]
    lines += [f"{head}: gained: {_words(other, j)}" for j in gained]
    return lines or [f"{head}: none in either"]


def match(one, other):
    """(pairs (i, j, distance), indices of `one` alone, indices of `other` alone)."""
    a, b = _in_disk(one), _in_disk(other)
    distances = sorted((_distance(a[i], b[j]), i, j) for i in range(len(a)) for j in range(len(b)))
    pairs, free_a, free_b = [], set(range(len(a))), set(range(len(b)))
    for distance, i, j in distances:
        if distance <= REACH and i in free_a and j in free_b:
            pairs.append((i, j, distance))
            free_a.remove(i)
            free_b.remove(j)
    return sorted(pairs), sorted(free_a), sorted(free_b)


def _in_disk(data):
    """Each orbit's points (2, n) in the unit disk."""
    ball = Ball(data.attrs["k"], data.attrs["g"])
    centre, radius = ball.section(data.attrs["energy"])
    x = (data["x"].values - centre) / radius
    y = data["xdot"].values - ball.k * data["udot"].values
    return list(np.stack([x, y / (radius * np.sqrt(ball.k * (1.0 + ball.k)))], axis=1))


def _distance(a, b):
    """Hausdorff's, of two sets of points (2, n)."""
    gaps = np.sqrt(np.sum((a[:, :, None] - b[:, None, :]) ** 2, axis=0))
    return float(max(np.max(np.min(gaps, axis=0)), np.max(np.min(gaps, axis=1))))


def _words(data, i):
    kind = str(data["type"].values[i])
    if kind == "elliptic":
        return f"elliptic (rotation {float(data['rotation_number'].values[i]):.4g})"
    return f"{kind} (multiplier {float(data['multiplier'].values[i]):.4g})"


def _listed(data):
    return ", ".join(_words(data, i) for i in range(data.sizes["orbit"])) or "none"
