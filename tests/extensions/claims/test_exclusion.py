"""Points that no invariant circle passes, against loops, proved curves and regular orbits."""

import numpy as np
import pytest

from extensions.atlas.symmetry_line import symmetric_fixed_point
from extensions.claims.analyses import exclusion
from helpers.sections import BALL
from pseudorigid import orbit

ENERGY = 0.01


@pytest.fixture(scope="module")
def excluded(datasets):
    return datasets["exclusion/exclusion"]


def radial(state, centre):
    return np.array([state[0] - centre, state[1] - BALL.k * state[2]])


def first_exclusion(state, centre, followed):
    """Carry radial vectors to a state with Jacobians, and look for a half plane by angles."""
    vectors, forward, backward = [radial(state, centre)], state, state
    ahead, behind = np.eye(2), np.eye(2)
    for n in range(1, followed + 1):
        ahead = np.array(BALL.chart_jacobian(*forward)) @ ahead
        forward = BALL.impact(*forward)[:3]
        vectors.append(np.linalg.inv(ahead / np.abs(ahead).max()) @ radial(forward, centre))
        backward = BALL.inverse_impact(*backward)[:3]
        behind = behind @ np.array(BALL.chart_jacobian(*backward))
        vectors.append(behind @ radial(backward, centre))
        angles = np.sort([np.arctan2(up, across) for across, up in vectors])
        gaps = np.diff([*angles, angles[0] + 2.0 * np.pi])
        if gaps.max() < np.pi:
            return n
    return 0


@pytest.mark.parametrize(("right", "up"), [(1.0, 2.0), (2.0, 1.0), (0.0, -1.0)])
def test_a_cone_holds_a_vector_along_it_and_no_opposite_one(right, up):
    cone = np.array([right, up, right, up])
    assert exclusion._widen_to_hold(cone, 2.0 * right, 2.0 * up)
    assert not exclusion._widen_to_hold(cone, -right, -up)


def test_points_are_excluded_by_their_radial_vectors(excluded):
    place, _ = symmetric_fixed_point(BALL, ENERGY)
    middle, radius = BALL.section(ENERGY)
    centre = middle + radius * place
    x, y, known = (excluded[name].values for name in ("x", "y", "excluded"))
    rows, columns = np.nonzero(known >= 0)
    for row, column in list(zip(rows, columns, strict=True))[::23]:
        state = BALL.state_xy(x[column], y[row], ENERGY)
        expected = first_exclusion(state, centre, 8)
        assert known[row, column] == expected or (expected == 0 and not 0 < known[row, column] < 9)


def test_curves_are_not_excluded_and_everything_else_is(excluded):
    """Grid points inside a regular curve around the fixed point, and in the sea."""
    place, _ = symmetric_fixed_point(BALL, ENERGY)
    middle, radius = BALL.section(ENERGY)
    centre = middle + radius * place
    curve = orbit(BALL, BALL.start(-0.8, ENERGY), 4000)
    points = np.array([curve["x"] - centre, curve["xdot"] - BALL.k * curve["udot"]])
    angle = np.arctan2(points[1], points[0])
    order = np.argsort(angle)
    x, y = np.meshgrid(excluded["x"].values - centre, excluded["y"].values)
    edge = np.interp(np.arctan2(y, x), angle[order], np.hypot(*points)[order], period=2 * np.pi)
    inside = np.hypot(x, y) < 0.97 * edge
    assert inside.sum() > 100
    known = excluded["excluded"].values
    assert np.all(known[inside] == 0)
    assert 0.8 < excluded["share"].values[-1] < 0.8421  # the proved curve leaves this outside
    assert np.array_equal(known, known[::-1])


def test_the_error_of_a_share_counts_a_point_and_its_mirror_image_once(excluded):
    share, count = excluded["share"].values, (excluded["excluded"].values >= 0).sum() // 2
    np.testing.assert_allclose(excluded["share_error"] ** 2, share * (1.0 - share) / count)
