"""The methods that are compared.

A method has a `name`, a `family` of methods that differ in one setting, and a function

    solve(ball, x, xdot, udot) -> (tau, evaluations)

of states just before an impact, arrays (n,). It returns flight times, NaN if none is found, and the
cost of each. `counted_methods` has the methods in this package's arithmetic, whose results are the
same on every machine. `scipy_events` and `taylor` have those of libraries, whose results are
measurements; `external_solver` applies them to one flight at a time. `pynamicalsys_lyapunov` has
the exponents of a library.
"""
