"""The searches: floating-point numbers that propose certificates, and prove nothing.

Of the package's other parts they use the ball map, for its midpoints, and the dynamics; the
checkers know nothing of them.
"""
