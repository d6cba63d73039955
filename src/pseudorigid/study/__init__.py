"""The map against every method it might have been computed with, and where those fail.

A method is an object with a `name`, a `family` and

    solve(ball, x, xdot, udot) -> (tau, evaluations)

for arrays of states just before an impact: the flight times, NaN where it found none, and what it
spent. `counted` has those compiled with this package's arithmetic (ours, the paper's scan, a
physics engine's time step), whose results are the same on every machine; `scipy_events` and
`taylor` have the libraries, whose results are measurements. `judge` proves the first root, by
none of these.

Nothing outside this package imports it, and its libraries come from requirements/study.txt.
"""
