"""Impact law, eq. (25), for numbers and arrays; `impact` compiles it."""


def impact_coefficients(k):
    """Return 2/(1 + k) as the sum of its first 26 bits and a double.

    With one rounded constant every impact would add the same relative error, 1e-16, to the energy.
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
    """Return the velocities b = xdot and c = udot just after an impact, eq. (25), and s = v + w.

    v (R omega) and w (omega) are xdot and udot just before the impact, `coefficients` those from
    `impact_coefficients`; all may be arrays or sympy expressions. The impact reverses the contact
    speed s: b + c = -s without rounding.
    """
    high, low = coefficients
    s = v + w
    e = s * high + s * low
    return v - k * e, w - e, s
