"""Derivations of the paper's section 2: motion, inertia, stiffness, scaling and impulse.

A number in parentheses is one of the paper's equations. `value` is that of the returned Formula.
"""

from collections.abc import Callable

import sympy as sp

from .symbols import E0, EV0, GRAVITY, PAPER, Formula, M, R, T, energy, g, k, rebound, v, w, x, zero


def equations_of_motion() -> Formula:
    """Derive the equations of motion (10), between impacts, from the Lagrangian (1)-(3)."""
    position, strain = sp.Function("X")(T), sp.Function("U")(T)
    kinetic = M * position.diff(T) ** 2 / 2 + E0 * strain.diff(T) ** 2 / 2
    potential = -M * GRAVITY * position + EV0 * strain**2 / 2
    equations = sp.calculus.euler.euler_equations(kinetic - potential, [position, strain], [T])
    printed = [M * position.diff(T, 2) - M * GRAVITY, E0 * strain.diff(T, 2) + EV0 * strain]
    return Formula(zero(*(e.lhs - e.rhs + p for e, p in zip(equations, printed, strict=True))))


def _over_sphere(f: Callable[[sp.Symbol], sp.Expr]) -> sp.Expr:
    """Integrate a function of the polar angle theta over the unit sphere."""
    theta, phi = sp.symbols("theta phi", positive=True)
    return sp.integrate(f(theta) * sp.sin(theta), (theta, 0, sp.pi), (phi, 0, 2 * sp.pi))


def euler_tensor() -> Formula:
    """Check (4): the integral of rho X3^2 is a third of the trace. Value: k of a uniform ball."""
    r = sp.symbols("r", positive=True)
    printed, corrected, inertias = True, True, []
    for power in (0, 1, 2, 7):  # of the radius, to which the density is proportional

        def over_ball(f: Callable[[sp.Symbol], sp.Expr], power: int = power) -> sp.Expr:
            return sp.integrate(r ** (power + 2) * _over_sphere(f), (r, 0, R))

        component = over_ball(lambda theta: (r * sp.cos(theta)) ** 2)
        trace, mass = over_ball(lambda theta: r**2), over_ball(lambda theta: 1)
        printed &= zero(component - trace)
        corrected &= zero(component - trace / 3)
        inertias.append(sp.simplify(component / (mass * R**2)))
    return Formula(printed, corrected, float(inertias[0]))


def shell() -> Formula:
    """Check (5) for a thin shell: k = 1 is printed, and the component X3^2 gives 1/3, the value."""
    inertia = _over_sphere(lambda theta: sp.cos(theta) ** 2) / _over_sphere(lambda theta: 1)
    return Formula(inertia == 1, inertia == sp.Rational(1, 3), float(inertia))


def _stiffness(young: sp.Symbol, nu: sp.Symbol) -> tuple[sp.Matrix, sp.Expr]:
    """Return the stiffness of the strains (11, 22, 33), and the shear modulus."""
    lame, shear = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    return sp.Matrix(3, 3, lambda i, j: lame + (2 * shear if i == j else 0)), shear


def momentum_balances() -> Formula:
    """Derive (2), and (10) with (9), from the balances of momentum of a pseudo-rigid body.

    Its points move like c + F X, with a matrix F. Cauchy's law rho a = div P + rho b, integrated
    over the body as it stands and times X, gives the balances of momentum and of its first moment
    (Cohen and Muncaster, reference [13]). The ball is linearly elastic with Poisson's ratio 0, and
    the floor pushes with the force `load` at X = (0, 0, R).
    """
    places = sp.symbols("X_1:4", real=True)
    stress = sp.Matrix(3, 3, lambda i, j: sp.Function(f"P_{i}{j}")(*places))

    def divergence(row: sp.Matrix) -> sp.Expr:
        return sum(component.diff(a) for component, a in zip(row, places, strict=True))

    # In the integral of (div P) X only the load on the edge and the mean of P are left.
    by_parts = [
        divergence(stress[i, :] * places[j]) - divergence(stress[i, :]) * places[j] - stress[i, j]
        for i in range(3)
        for j in range(3)
    ]
    theta, phi = sp.symbols("theta phi", positive=True)
    way = sp.Matrix([sp.sin(theta) * f(phi) for f in (sp.cos, sp.sin)] + [sp.cos(theta)])
    first, second = (
        sp.integrate(a * sp.sin(theta), (theta, 0, sp.pi), (phi, 0, 2 * sp.pi)) / (4 * sp.pi)
        for a in (way, way * way.T)  # means over each shell, of which the ball consists
    )
    inertia = 3 * E0 * second
    young, nu, load = sp.symbols("Y nu f", positive=True)
    position, strain = sp.Function("X")(T), sp.Function("U")(T)
    along = sp.Matrix([0, 0, 1])
    centre, deformation = position * along, sp.eye(3) + strain * along * along.T
    mean_stress = sp.diag(*(_stiffness(young, nu)[0].subs(nu, 0) * strain * along))
    relative, bend = centre.diff(T, 2) - GRAVITY * along, deformation.diff(T, 2)
    momentum = M * (relative + bend * first) + load * along
    moment = M * relative * first.T + bend * inertia + load * R * along * along.T
    moment += EV0 / young * mean_stress  # EV0 is Young's modulus times the volume
    speed, rate = centre.diff(T), deformation.diff(T)
    kinetic = (M * speed.dot(speed) + (rate * inertia * rate.T).trace()) / 2
    kinetic += M * speed.dot(rate * first)
    printed_momentum = M * position.diff(T, 2) - M * GRAVITY + load
    printed_moment = E0 * strain.diff(T, 2) + EV0 * strain + R * load
    return Formula(zero(
        *by_parts,
        *(momentum - printed_momentum * along),
        *(moment - printed_moment * along * along.T),
        kinetic - M * position.diff(T) ** 2 / 2 - E0 * strain.diff(T) ** 2 / 2,
    ))  # fmt: skip


def uncoupled() -> Formula:
    """Check that a force along an axis strains that axis alone only if Poisson's ratio is 0."""
    young, nu = sp.symbols("Y nu", positive=True)
    moduli, _ = _stiffness(young, nu)
    axes_are_uncoupled = moduli.subs(nu, 0) == young * sp.eye(3) and not zero(moduli[0, 1])
    # the two deviatoric modes have one stiffness
    two_modes_are_equal = sorted(moduli.eigenvals().values()) == [1, 2]
    return Formula(bool(axes_are_uncoupled and two_modes_are_equal))


def modes() -> Formula:
    """Check that an axial force excites three of the six strain modes: it excites two, the value.

    Strains are (11, 22, 33) and the three shears, which all have the same inertia. A force along 3
    excites the span of its direction and of the images of this direction under powers of the
    stiffness.
    """
    normal, shear = _stiffness(*sp.symbols("Y nu", positive=True))
    stiffness = sp.diag(normal, 2 * shear * sp.eye(3))
    columns = [sp.Matrix([0, 0, 1, 0, 0, 0])]
    for _ in range(5):
        columns.append(stiffness * columns[-1])
    excited = sp.Matrix.hstack(*columns)
    rank = excited.rank(simplify=True)
    two_modes_are_equal = sorted(normal.eigenvals().values()) == [1, 2]
    holds = zero(*excited[3:, :]) and two_modes_are_equal
    return Formula(rank == 3 and holds, rank == 2 and holds, float(rank))


def softness() -> Formula:
    """Compute as the value Young's modulus over density, GRAVITY and R, for g and k of PAPER."""
    density, young = sp.symbols("rho Y", positive=True)
    omega2 = young / (k * density * R**2)  # (16) with (5)
    needed = sp.solve(GRAVITY / (omega2 * R) - g, young)[0]
    ratio = sp.simplify(needed.subs(PAPER) / (density * GRAVITY * R))
    return Formula(None, bool(ratio.is_number), float(ratio))


_BEFORE = sp.symbols("xm um", real=True)  # velocities just before the impact
_PRINTED_IMPULSE = 2 * k / (1 + k) * M * (_BEFORE[0] + R * _BEFORE[1])


def impulse() -> Formula:
    """Derive the impulse (13), which changes both velocities and keeps the energy, (11)-(12)."""
    (before_x, before_u), p = _BEFORE, sp.symbols("p", real=True)
    inertia = k * M * R**2
    after = before_x - p / M, before_u - R * p / inertia
    energy_change = M * (after[0] ** 2 - before_x**2) + inertia * (after[1] ** 2 - before_u**2)
    nontrivial = [s for s in sp.solve(energy_change, p) if s != 0]
    return Formula(len(nontrivial) == 1 and zero(nontrivial[0] - _PRINTED_IMPULSE))


def impulse_without_stiffness() -> Formula:
    """Check that (13) contains no stiffness EV0."""
    return Formula(EV0 not in _PRINTED_IMPULSE.free_symbols and impulse().printed)


def jump_conditions() -> Formula:
    """Derive (14) and (25), an involution that keeps the energy and reverses the contact speed."""
    after = rebound(v, w)
    again = rebound(*after)
    return Formula(zero(
        after[0] - ((1 - k) / (1 + k) * v - 2 * k / (1 + k) * w),
        after[1] - (-2 / (1 + k) * v - (1 - k) / (1 + k) * w),
        energy(x, *after) - energy(x, v, w),
        sum(after) + v + w,
        again[0] - v,
        again[1] - w,
    ))  # fmt: skip


_MASS, _LENGTH, _TIME = sp.symbols("mass length time", positive=True)
_FORCE, _IMPULSE = _MASS * _LENGTH / _TIME**2, _MASS * _LENGTH / _TIME


def impulsive_forces() -> Formula:
    """Check (9) by dimensions: p is an impulse, so p without a delta is no force."""
    delta = 1 / _TIME
    multiplier = sp.cancel(_FORCE / delta)  # of the first line's last member, -p delta
    # the slopes of phi_2 = x + R u and the forces conjugate to x and u
    pairs = (1, _FORCE), (_LENGTH, _FORCE * _LENGTH)
    printed = all(sp.cancel(multiplier * slope / force) == 1 for slope, force in pairs)
    corrected = all(sp.cancel(multiplier * slope * delta / force) == 1 for slope, force in pairs)
    return Formula(printed, corrected)


def scaled_impulse() -> Formula:
    """Check (24), printed with omega^2 for omega, by dimensions and from (10) in scaled time."""
    rate, p = sp.symbols("omega p", positive=True)
    omega = 1 / _TIME
    scaled = p * rate / (M * R * rate**2)  # delta(t) = omega delta(omega t)
    holds = []
    for power in (2, 1):
        pure = sp.cancel(_IMPULSE / (_MASS * omega**power * _LENGTH)) == 1
        holds.append(pure and zero(scaled - p / (M * rate**power * R)))
    return Formula(*holds)


def scaling() -> Formula:
    """Derive (15)-(20): k and g are left, and g depends on the unit of length, which is free."""
    rate, position, strain, unit = sp.symbols("omega X U L", positive=True)
    dx, du = sp.symbols("dX dU", real=True)
    inertia = k * M * R**2
    kinetic = M * (R * rate * dx) ** 2 / 2 + inertia * (rate * du) ** 2 / 2
    potential = -M * GRAVITY * R * position + rate**2 * inertia * strain**2 / 2
    scaled = dx**2 / 2 + k * du**2 / 2 + g * position - k * strain**2 / 2
    scaled = scaled.subs(g, GRAVITY / (rate**2 * R))
    scaled_up = {a: unit * a for a in (x, v, w, g)}
    total_energy = energy(x, v, w)
    scaling_residual = total_energy.subs(scaled_up, simultaneous=True) - unit**2 * total_energy
    return Formula(zero((kinetic - potential) / (M * rate**2 * R**2) - scaled, scaling_residual))
