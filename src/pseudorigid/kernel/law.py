"""The impact law, eq. (25), on numbers or arrays; `impact` has it compiled."""


def transfer(k):
    """2/(1 + k) as a sum of a 26-bit number and a double.

    With one rounded constant every impact would add the same relative error of 1e-16 to the energy.
    """
    total = 1.0 + k
    missing = k - (total - 1.0)
    ratio = 2.0 / total
    cut = 134217729.0 * ratio
    head = cut - (cut - ratio)
    cut = 134217729.0 * total
    upper = cut - (cut - total)
    rest = ((2.0 - head * upper) - head * (total - upper)) - head * missing
    return head, rest / total


def rebound(v, w, k, head, low):
    """Velocities (b, c) just after an impact, eq. (25), and s = v + w = -(b + c), exact.

    (head, low) is `transfer(k)`. Numbers or arrays.
    """
    s = v + w
    e = s * head + s * low
    return v - k * e, w - e, s
