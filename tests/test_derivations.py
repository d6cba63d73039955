"""The paper's formulas and the code's, derived again from the Lagrangian by computer algebra.

Equations are those of the paper as printed. Where a printed one is wrong the test transcribes it,
shows that it does not hold, and that the corrected one does. What the code computes is called with
symbols where it is plain arithmetic, and with numbers where it is compiled.
"""

import numpy as np
import pytest
import sympy as sp

from pseudorigid import Ball, orbit
from pseudorigid.dynamics import fixed_point
from pseudorigid.kernel import impact, law

# dimensional: radius, mass, inertia, stiffness EV0, gravity, time
R, M, E0, EV0, GRAVITY, T = sp.symbols("R m E_0 E_V gamma t", positive=True)
# dimensionless
k, g, tau = sp.symbols("k g tau", positive=True)
x, v, w, b, c, y, E = sp.symbols("x v w b c y E", real=True)


def zero(expression):
    return sp.simplify(sp.expand(sp.expand_trig(expression))) == 0


def rebound(v, w):
    """The code's impact law, eq. (25), on symbols: (b, c)."""
    return law.rebound(v, w, k, 2 / (1 + k), 0)[:2]


def flight(x, b, c, t):
    """Eq. (26): position and strain a time t after an impact."""
    return x + b * t + g * t**2 / 2, c * sp.sin(t) - x * sp.cos(t)


def energy(x, v, w):
    """Eq. (29)."""
    return v**2 / 2 + k * w**2 / 2 - g * x + k * x**2 / 2


# -- the model ------------------------------------------------------------------------------------


def test_equations_of_motion_follow_from_the_lagrangian():
    position, strain = sp.Function("X")(T), sp.Function("U")(T)
    kinetic = M * position.diff(T) ** 2 / 2 + E0 * strain.diff(T) ** 2 / 2
    potential = -M * GRAVITY * position + EV0 * strain**2 / 2
    found = sp.calculus.euler.euler_equations(kinetic - potential, [position, strain], [T])
    # eq. (10) between impacts
    expected = [M * position.diff(T, 2) - M * GRAVITY, E0 * strain.diff(T, 2) + EV0 * strain]
    for equation, wanted in zip(found, expected, strict=True):
        assert zero(equation.lhs - equation.rhs + wanted)


def euler_tensor(density):
    """(component, trace) of the integral of density X X^T over the ball, and its mass."""
    r, theta, phi = sp.symbols("r theta phi", positive=True)
    volume = r**2 * sp.sin(theta)

    def over_ball(f):
        ranges = ((r, 0, R), (theta, 0, sp.pi), (phi, 0, 2 * sp.pi))
        return sp.integrate(density(r) * f * volume, *ranges)

    return over_ball((r * sp.cos(theta)) ** 2), over_ball(r**2), over_ball(1)


def test_euler_tensor_has_a_third_that_the_paper_leaves_out():
    for power in (0, 1, 2, 7):
        component, printed, mass = euler_tensor(lambda r, n=power: r**n)
        # T = integral of rho (X3 udot)^2 / 2, so E0 is the component, not eq. (4)
        assert not zero(component - printed)
        assert zero(component - printed / 3)
        assert sp.simplify(component / (mass * R**2)) < sp.Rational(1, 3)
    component, printed, mass = euler_tensor(lambda r: sp.Integer(1))
    assert sp.simplify(component / (mass * R**2)) == sp.Rational(1, 5)  # a solid sphere: k = 1/5
    assert sp.simplify(printed / (mass * R**2)) == sp.Rational(3, 5)  # by eq. (4) as printed


def test_shell_has_a_third_and_not_one():
    theta, phi = sp.symbols("theta phi", positive=True)
    ranges = ((theta, 0, sp.pi), (phi, 0, 2 * sp.pi))
    area = R**2 * sp.sin(theta)
    mass = sp.integrate(area, *ranges)
    component = sp.integrate((R * sp.cos(theta)) ** 2 * area, *ranges)
    printed = sp.integrate(R**2 * area, *ranges)
    assert sp.simplify(printed / (mass * R**2)) == 1
    assert sp.simplify(component / (mass * R**2)) == sp.Rational(1, 3)


def test_without_poissons_ratio_the_stretches_are_uncoupled():
    young, nu = sp.symbols("Y nu", positive=True)
    lame, shear = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    moduli = sp.Matrix(3, 3, lambda i, j: lame + (2 * shear if i == j else 0))
    assert moduli.subs(nu, 0) == young * sp.eye(3)  # a force along an axis strains that axis alone
    assert not zero(moduli[0, 1])
    values = {sp.simplify(value): n for value, n in moduli.eigenvals().items()}
    assert sorted(values.values()) == [1, 2]  # the two deviatoric modes are alike


def test_gravity_in_terms_of_youngs_modulus():
    density, young = sp.symbols("rho Y", positive=True)
    volume = 4 * sp.pi * R**3 / 3
    mass = density * volume
    omega2 = young * volume / (k * mass * R**2)  # eq. (16) with (5)
    scaled = GRAVITY / (omega2 * R)  # eq. (20)
    needed = sp.solve(scaled - sp.Rational(1, 25), young)[0].subs(k, sp.Rational(1, 5))
    assert zero(needed - 5 * density * GRAVITY * R)  # g = 0.04: five times rho g R


# -- the impact -----------------------------------------------------------------------------------


def test_impulse_and_jump_conditions():
    before_x, before_u, p = sp.symbols("xm um p", real=True)
    inertia = k * M * R**2  # eq. (5)
    after_x, after_u = before_x - p / M, before_u - R * p / inertia  # eq. (11)
    kept = M * (after_x**2 - before_x**2) + inertia * (after_u**2 - before_u**2)  # eq. (12)
    solutions = sp.solve(kept, p)
    nontrivial = [s for s in solutions if s != 0]
    assert len(nontrivial) == 1
    (impulse,) = nontrivial
    assert zero(impulse - 2 * k / (1 + k) * M * (before_x + R * before_u))  # eq. (13)
    assert EV0 not in impulse.free_symbols  # it does not depend on the stiffness
    eq14 = (
        (1 - k) / (1 + k) * before_x - 2 * k / (1 + k) * R * before_u,
        -2 / (1 + k) / R * before_x - (1 - k) / (1 + k) * before_u,
    )
    for found, printed in zip((after_x, after_u), eq14, strict=True):
        assert zero(found.subs(p, impulse) - printed)


def test_impact_law_of_the_code_is_equation_25():
    after = rebound(v, w)
    printed = (
        (1 - k) / (1 + k) * v - 2 * k / (1 + k) * w,
        -2 / (1 + k) * v - (1 - k) / (1 + k) * w,
    )
    assert all(zero(one - other) for one, other in zip(after, printed, strict=True))
    b, c = after
    assert zero(energy(x, b, c) - energy(x, v, w))
    assert zero(b + c + (v + w))  # the contact speed is reversed
    assert all(zero(one - other) for one, other in zip(rebound(b, c), (v, w), strict=True))


MASS, LENGTH, TIME = sp.symbols("mass length time", positive=True)
FORCE, IMPULSE = MASS * LENGTH / TIME**2, MASS * LENGTH / TIME


def test_equation_9_lacks_a_delta():
    delta = 1 / TIME  # its integral over time is a number
    multiplier = sp.cancel(FORCE / delta)  # from the last member of the first line, -p delta
    assert multiplier == IMPULSE
    slope_x, slope_u = 1, LENGTH  # of phi_2 = x + R u, eq. (7)
    force_u = FORCE * LENGTH  # conjugate to a strain
    for slope, force in ((slope_x, FORCE), (slope_u, force_u)):
        printed = multiplier * slope  # - p d phi_2/dx, and R p of the second line
        assert sp.cancel(printed / force) != 1
        assert sp.cancel(printed * delta / force) == 1


def test_equation_24_divides_by_omega_once_too_often():
    omega = 1 / TIME
    assert sp.cancel(IMPULSE / (MASS * omega**2 * LENGTH)) == TIME  # as printed: a time
    assert sp.cancel(IMPULSE / (MASS * omega * LENGTH)) == 1
    # from eq. (10) with x = R x', t = t'/omega: the delta in t' is delta/omega
    rate, p = sp.symbols("omega p", positive=True)
    dimensionless = p * rate / (M * R * rate**2)  # the factor of the delta in (23)
    assert zero(dimensionless - p / (M * rate * R))
    assert not zero(dimensionless - p / (M * rate**2 * R))


# -- scaling, flight, map -------------------------------------------------------------------------


def test_scaling_leaves_two_numbers():
    rate, position, strain = sp.symbols("omega X U", positive=True)
    dx, du = sp.symbols("dX dU", real=True)  # by dimensionless time
    inertia = k * M * R**2
    stiffness = rate**2 * inertia  # eq. (16)
    lagrangian = (
        M * (R * rate * dx) ** 2 / 2
        + inertia * (rate * du) ** 2 / 2
        + M * GRAVITY * R * position
        - stiffness * strain**2 / 2
    )
    scaled = dx**2 / 2 + k * du**2 / 2 + g * position - k * strain**2 / 2  # eqs. (17)-(19)
    scaled = scaled.subs(g, GRAVITY / (rate**2 * R))  # eq. (20)
    assert zero(lagrangian / (M * rate**2 * R**2) - scaled)


def test_everything_scales_with_the_unit_of_length():
    unit = sp.symbols("L", positive=True)
    big = {x: unit * x, v: unit * v, w: unit * w, g: unit * g}
    after = rebound(v, w)
    gap = sum(flight(x, *after, tau))
    assert zero(gap.subs(big, simultaneous=True) - unit * gap)
    assert zero(energy(x, v, w).subs(big, simultaneous=True) - unit**2 * energy(x, v, w))


def test_flight_solves_the_equations_of_motion():
    position, strain = flight(x, b, c, T)
    assert zero(position.diff(T, 2) - g)
    assert zero(strain.diff(T, 2) + strain)
    start = [position, position.diff(T), strain, strain.diff(T)]
    for found, wanted in zip((a.subs(T, 0) for a in start), (x, b, -x, c), strict=True):
        assert zero(found - wanted)
    # eq. (27)
    after = rebound(v, w)[0]
    printed = (position.diff(T).subs(T, tau) - b) / g
    assert zero(printed - tau)
    assert zero(after - ((1 - k) / (1 + k) * v - 2 * k / (1 + k) * w))


def map_28(sign):
    """(28) as residuals of (x, v, w) -> (x1, v1, w1), with this sign in its first line."""
    x1, v1, w1 = sp.symbols("x1 v1 w1", real=True)
    first = (1 - k) / (1 + k) * v + sign * 2 * k / (1 + k) * w
    angle = (v1 - (1 - k) / (1 + k) * v + 2 * k / (1 + k) * w) / g
    other = 2 / (1 + k) * v + (1 - k) / (1 + k) * w
    return (x1, v1, w1), (
        g * (x1 - x) - v1**2 / 2 + first**2 / 2,
        x1 - x * sp.cos(angle) - other * sp.sin(angle),
        w1 - x * sp.sin(angle) + other * sp.cos(angle),
    )


def test_map_28_has_a_misprinted_sign():
    b, c = rebound(v, w)
    position, strain = flight(x, b, c, tau)
    (x1, v1, w1), printed = map_28(+1)
    _, corrected = map_28(-1)
    after = {v1: b + g * tau, w1: strain.diff(tau)}
    # the first line is about the centre, the second about the strain, u = -x at an impact
    assert not zero(printed[0].subs(x1, position).subs(after))
    assert zero(corrected[0].subs(x1, position).subs(after))
    for line, place in ((1, -strain), (2, -strain)):
        residual = corrected[line].subs(x1, place).subs(after)
        assert zero(residual.subs(v1, b + g * tau))


def test_map_28_has_many_solutions_and_the_smallest_is_meant():
    ball = Ball(0.2, 0.04)
    gap = sp.lambdify((x, v, w, k, g, tau), sum(flight(x, *rebound(v, w), tau)), "numpy")
    times = np.linspace(1e-3, 12.0, 12_000)
    many = 0
    path = orbit(ball, ball.state_xy(0.4, 0.0, 0.01), 200)
    for state in zip(*(path[name].values for name in ("x", "xdot", "udot")), strict=True):
        heights = gap(*state, ball.k, ball.g, times)
        roots = times[1:][heights[1:] * heights[:-1] < 0.0]
        assert abs(roots[0] - ball.impact(*state)[3]) < 2e-3
        many += roots.size > 1  # every root solves (28): its time of flight is not in it
    assert many > 0


def test_energy_is_kept_and_is_an_ellipsoid():
    b, c = sp.symbols("b c", real=True)
    position, strain = flight(x, b, c, tau)
    height, stretch = position.diff(tau), strain.diff(tau)
    whole = height**2 / 2 + k * stretch**2 / 2 - g * position + k * strain**2 / 2
    assert zero(whole - energy(x, b, c))
    # at an impact u = -x, and that is eq. (29)
    assert zero(energy(x, v, w) - (v**2 / 2 + k * w**2 / 2 - g * x + k * x**2 / 2))
    hessian = sp.hessian(energy(x, v, w), (x, v, w))
    assert all(value.is_positive for value in hessian.eigenvals())
    assert Ball(0.3, 0.07).energy(0.2, -0.1, 0.5) == pytest.approx(
        float(energy(x, v, w).subs({x: 0.2, v: -0.1, w: 0.5, k: 0.3, g: 0.07})), rel=1e-15
    )


# -- bounds ---------------------------------------------------------------------------------------


def test_bound_on_the_energy_needs_g_below_k():
    potential = k * x**2 / 2 - g * x  # eq. (30)
    bound = k / 2 - g
    assert zero(potential.subs(x, 1) - bound)
    largest = g / k + sp.sqrt(2 * E / k + g**2 / k**2)  # where the kinetic energy is 0
    assert zero(potential.subs(x, largest) - E)
    at_bound = largest.subs(E, bound)
    small, stiff = sp.symbols("small stiff", positive=True)
    assert sp.simplify(at_bound.subs(k, g + stiff)) == 1  # g < k: the largest x is 1
    assert sp.simplify(at_bound.subs(g, k + small)) != 1  # g > k: it is 2 g/k - 1 > 1
    assert Ball(0.2, 0.04).energy_bounds()[1] == pytest.approx(0.06, abs=1e-17)


def test_in_flight_the_strain_stays_within_the_largest_at_an_impact():
    amplitude2 = x**2 + c**2
    # from (29) just after an impact, with velocities b, c
    found = sp.solve(energy(x, b, c) - E, c)[0] ** 2 + x**2
    assert zero(found - (2 * (E + g * x) - b**2) / k)  # so A^2 <= 2 (E + g x)/k
    largest = g / k + sp.sqrt(2 * E / k + g**2 / k**2)
    assert zero(2 * (E + g * largest) / k - largest**2)
    assert sp.diff(2 * (E + g * x) / k, x) > 0  # and rises with x up to its largest value
    # the amplitude is that of u in flight
    strain = flight(x, b, c, T)[1]
    assert zero(strain**2 + strain.diff(T) ** 2 - amplitude2)


def test_map_is_smooth_up_to_an_energy():
    # a flight can touch the floor, f = f' = 0, only where f'' = g + x' <= 0 on the rim
    smallest = g / k - sp.sqrt(2 * E / k + g**2 / k**2)
    (threshold,) = sp.solve(smallest + g, E)
    assert zero(threshold - g**2 * (1 + k / 2))
    assert float(threshold.subs({k: 0.2, g: 0.04})) == pytest.approx(0.00176, rel=1e-12)


# -- derivatives ----------------------------------------------------------------------------------

DIRECTION = sp.symbols("dx dv dw", real=True)


def derived_tangent():
    """The tangent map of one impact and flight, from f = 0 by the implicit function theorem."""
    b, c = rebound(v, w)
    position, strain = flight(x, b, c, tau)
    gap = position + strain
    slope = gap.diff(tau)
    old = (x, v, w)
    dtau = -sum(gap.diff(a) * d for a, d in zip(old, DIRECTION, strict=True)) / slope
    new = (-strain, b + g * tau, strain.diff(tau))
    return [
        sum(n.diff(a) * d for a, d in zip(old, DIRECTION, strict=True)) + n.diff(tau) * dtau
        for n in new
    ]


def test_tangent_map_of_the_code():
    b, c = rebound(v, w)
    sine, cosine = sp.sin(tau), sp.cos(tau)
    _, strain = flight(x, b, c, tau)
    slope = sum(flight(x, b, c, tau)).diff(tau)
    # as in impact.flight_derivatives
    parts = -(1 - cosine) / slope, tau / slope, -(sine - tau) / slope
    names = dict(impact.tangent.py_func.__globals__)
    names["rebound"] = law.rebound
    plain = type(impact.tangent.py_func)(impact.tangent.py_func.__code__, names)
    arguments = (k, g, 2 / (1 + k), 0, -strain, strain.diff(tau), sine, cosine, *parts)
    for found, wanted in zip(plain(*DIRECTION, *arguments), derived_tangent(), strict=True):
        assert sp.simplify(found - wanted) == 0


def test_jacobian_from_nine_linear_equations():
    (x1, v1, w1), lines = map_28(-1)
    old, new = (x, v, w), (x1, v1, w1)
    lines = sp.Matrix(lines)
    nine = -lines.jacobian(new).LUsolve(lines.jacobian(old))
    ball = Ball(0.2, 0.04)
    state = ball.state_xy(0.31, 0.02, 0.01)
    after = ball.impact(*state)
    values = dict(zip((*old, *new), (*state, *after[:3]), strict=True)) | {k: ball.k, g: ball.g}
    expected = np.array(nine.subs(values).evalf(), dtype=float)
    np.testing.assert_allclose(ball.jacobian(*state), expected, rtol=1e-9, atol=1e-9)


def jacobian():
    return sp.Matrix(
        [[row.coeff(d) for d in DIRECTION] for row in map(sp.expand, derived_tangent())]
    )


def random_flights(count=6):
    """Values of symbols to 40 digits for flights that end in an impact."""
    bits = np.random.default_rng(5)
    for _ in range(count):
        values = {k: sp.Rational(1, 5), tau: sp.Rational(str(round(bits.uniform(1, 7), 6)))}
        values |= {a: sp.Rational(str(round(bits.uniform(-0.5, 0.5), 6))) for a in (x, v, w)}
        rest = sum(flight(x, *rebound(v, w), tau)).subs(g, 0)
        yield values | {g: (-2 * rest / tau**2).subs(values)}


def test_determinants():
    matrix = jacobian()
    energy_row = sp.Matrix([[energy(x, v, w).diff(a) for a in (x, v, w)]])
    b, c = rebound(v, w)
    after = flight(x, b, c, tau)[1].diff(tau) + b + g * tau
    for values in random_flights():
        numbers = matrix.subs(values).evalf(40)
        old, new = (v + w).subs(values).evalf(40), after.subs(values).evalf(40)
        # in three dimensions it is s/s', whose product telescopes: the exponents add up to 0
        assert abs(numbers.det() * new - old) < 1e-30
        # on the energy surface, with y = v - k w, it is 1
        basis = energy_row.subs(values).evalf(40).nullspace()
        chart = sp.Matrix([[1, 0, 0], [0, 1, -k]]).subs(values)
        before = (chart * sp.Matrix.hstack(*basis)).det()
        carried = (chart * numbers * sp.Matrix.hstack(*basis)).det()
        assert abs(carried / before - 1) < 1e-30


def test_exponents_of_equation_32_need_the_factor():
    i, rate = sp.symbols("i lambda", positive=True)
    growth = i * rate  # ln ||J_i ... J_1 v|| of a constant J = e^lambda
    assert sp.limit(growth, i, sp.oo) == sp.oo  # as printed
    assert sp.limit(growth / i, i, sp.oo) == rate


# -- symplecticity --------------------------------------------------------------------------------


def test_one_form_is_well_defined_at_an_impact():
    velocity, rate = sp.symbols("xd ud", real=True)
    position, strain = sp.symbols("X U", real=True)
    lagrangian = velocity**2 / 2 + k * rate**2 / 2 + g * position - k * strain**2 / 2
    form = lagrangian.diff(velocity), lagrangian.diff(rate)  # (34): of dx and of du
    assert form == (velocity, k * rate)  # (36)
    # on the section du = -dx: (38)
    on_section = (form[0] - form[1]).subs({velocity: v, rate: w})
    assert zero(on_section - (v - k * w))
    b, c = rebound(v, w)
    assert zero((b - k * c) - (v - k * w))


def action(x, b, c, t):
    """The integral of xdot^2 + k udot^2 over a flight, in closed form."""
    both = sp.sin(t) * sp.cos(t)
    return (
        b**2 * t
        + b * g * t**2
        + g**2 * t**3 / 3
        + k * ((x**2 * (t - both) + c**2 * (t + both)) / 2 + x * c * sp.sin(t) ** 2)
    )


def test_flights_keep_the_area_at_fixed_energy_though_their_times_vary():
    position, strain = flight(x, b, c, tau)
    rate, stretch = position.diff(tau), strain.diff(tau)
    integrand = rate**2 + k * stretch**2
    assert zero(action(x, b, c, tau).diff(tau) - integrand)
    assert action(x, b, c, 0) == 0
    # Poincare and Cartan: d(action) = [xdot dx + k udot du] between the ends + tau dE, whatever
    # the variations of x, b, c and tau
    whole = energy(x, b, c)
    for variable in (x, b, c, tau):
        end = rate * position.diff(variable) + k * stretch * strain.diff(variable)
        start = {x: b - k * c, b: 0, c: 0, tau: 0}[variable]  # xdot dx + k udot du, u = -x
        difference = action(x, b, c, tau).diff(variable) - (end - start)
        assert zero(difference - tau * whole.diff(variable))


# -- the fixed point ------------------------------------------------------------------------------


def test_fixed_point_in_closed_form():
    theta = sp.symbols("theta", positive=True)
    place = g * theta / k * sp.cot(theta)
    speed, rate = g * theta, g * theta / k
    b, c = rebound(speed, rate)
    position, strain = flight(place, b, c, 2 * theta)
    assert zero((b + 2 * g * theta) - speed)
    assert zero((position - place).rewrite(sp.sin))
    assert sp.simplify((strain + place).rewrite(sp.tan)) == 0
    whole = energy(place, speed, rate) / g**2
    for value in (0.4, 1.1, 1.5002, 2.3):
        for inertia in (0.1, 0.2, 1.0 / 3.0):
            expected = float(whole.subs({theta: value, k: inertia}))
            assert fixed_point.energy(inertia, value) == pytest.approx(expected, rel=1e-13)


def test_trace_of_the_fixed_point():
    matrix = jacobian()
    for inertia, theta in ((0.2, 1.5002), (0.3, 0.7), (0.1, 2.2)):
        values = {k: sp.Float(inertia, 40), g: sp.Float(1, 40), tau: sp.Float(2 * theta, 40)}
        half = values[tau] / 2
        values |= {v: half, w: half / values[k], x: half / sp.tan(half) / values[k]}
        trace = float(matrix.subs(values).evalf(30).trace()) - 1.0
        assert fixed_point.trace(inertia, theta) == pytest.approx(trace, rel=1e-12)
