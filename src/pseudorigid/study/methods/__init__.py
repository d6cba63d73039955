"""The methods that are compared.

A method has a `name`, a `family` (methods that differ in one setting) and

    solve(ball, x, xdot, udot) -> (tau, evaluations)

for arrays (n,) of states just before an impact: the flight times, NaN where it found none, and
what each took. `counted` has those compiled with this package's arithmetic, whose results are the
same on every machine; `scipy_events` and `taylor` have the libraries', whose results are
measurements, one function of one flight each, on `rival`. `toolkit` has a library's exponents.
"""
