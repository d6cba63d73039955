"""The impact law, eq. (25), on numbers or arrays; `impact` has it compiled."""


def impact_coefficients(k):
    """2/(1 + k) as a sum of a 26-bit number and a double.

    With one rounded constant every impact would add the same relative error of 1e-16 to the energy.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).

    Returns
    -------
    coefficients : float
        The first 26 bits, and the rest rounded to a double.
    """
    total = 1.0 + k
    missing = k - (total - 1.0)
    ratio = 2.0 / total
    cut = 134217729.0 * ratio
    high = cut - (cut - ratio)
    cut = 134217729.0 * total
    upper = cut - (cut - total)
    rest = ((2.0 - high * upper) - high * (total - upper)) - high * missing
    return high, rest / total


def rebound(v, w, k, coefficients):
    """Velocities just after an impact, eq. (25).

    Parameters
    ----------
    v, w : float, ndarray or sympy.Expr
        xdot (R omega) and udot (omega) just before the impact.
    k : float or sympy.Symbol
        Euler inertia, eq. (5).
    coefficients : float or sympy.Expr
        2/(1 + k) in two parts, as from `impact_coefficients`.

    Returns
    -------
    b, c : same as v, w
        xdot and udot just after the impact.
    s : same
        v + w, the contact point's speed, which the impact reverses: b + c = -s, without rounding.
    """
    high, low = coefficients
    s = v + w
    e = s * high + s * low
    return v - k * e, w - e, s
