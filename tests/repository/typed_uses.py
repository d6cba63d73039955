"""Uses of the package for type checkers: they refuse each line that ends so, and no other one."""

from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

import pseudorigid
from pseudorigid import (
    Ball,
    Picture,
    classify_orbits,
    lyapunov_spectrum,
    orbit,
    periodic_orbits,
    rotation_number,
    symmetric_orbits,
    trace_manifold,
    with_parameters,
)

# A ball and its methods.
shell = Ball(Fraction(1, 3), g=np.float64(0.04))
ball: Ball = Ball(k=shell.k / 2, g=0.04)
x, xdot, udot, tau = ball.impact(0.4, 0.02, np.array(0.1))
ratio: float = round(tau, 6) / ball.k
column = pd.Series([0.1, 0.2])
state = ball.start([0.5, -0.2], 0.01)
state = ball.start([[0.5], (Fraction(1, 2),)], energy=np.linspace(0.01, 0.02, 3))
state = ball.start(Decimal("0.1"), np.float32(0.01))
state = ball.start(np.ma.masked_array([0.1, 0.2], [True, False]), 0.01)
state = ball.start(column, 0.01)
state = ball.start([column, column], 0.01)
state = ball.state(0.1, 0.1, 0.01, branch=-1)
ball.jacobian(0.1, 0.1, 0.1, impacts=np.int64(2))
Ball("0.2", 0.04)  # refused
Ball(k=0.2)  # refused
ball.k = 0.3  # refused
ball.impacts(*state)  # refused
ball.impact(state)  # refused
ball.start(None, 0.01)  # refused
ball.start("0.4", 0.01)  # refused
ball.start(["0.4"], 0.01)  # refused
ball.start(1j, 0.01)  # refused
ball.state(0.1, 0.1, 0.01, 2)  # refused

# Orbits.
many: xr.Dataset = orbit(ball, (np.zeros(3), 0.1, [0.1, 0.2, Fraction(1, 3)]), 3, keep="last")
orbit(ball, many, impacts=int(many["x"].size))
orbit(ball, [0.1, 0.1, 0.1], 3)
orbit(ball, np.full((3, 2), 0.1), 3)
orbit(ball, (many["x"], many["xdot"], many["udot"]), 3)
orbit(ball, (column, column, column), impacts=np.int64(5))
orbit(ball, state, np.array(5), keep="all").to_netcdf("orbit.nc")
classify_orbits(ball, (0.1, 0.2, 0.3))["type"].values.tolist()
rotation_number(ball, many, impacts=np.int64(1000))
lyapunov_spectrum(ball, many, 10, records=np.int64(3))
pseudorigid.motion(ball, (0.1, 0.2, 0.3), duration=Fraction(3, 2))
orbit(ball, state, impact=3)  # refused
orbit(ball, state)  # refused
orbit((0.2, 0.04), state, 3)  # refused
orbit(ball, 0.4, 3)  # refused
orbit(ball, ("0.1", 0.1, 0.1), 3)  # refused
orbit(ball, state, 3.5)  # refused
orbit(ball, state, impacts="3")  # refused
orbit(ball, state, 3, keep="first")  # refused
rotation_number(ball, None)  # refused
lyapunov_spectrum(ball, state, impacts=[3])  # refused
lyapunov_spectrum(ball, state, 10, records=None)  # refused
pseudorigid.motion(ball, state, "16")  # refused

# Periodic orbits and manifolds.
six = symmetric_orbits(ball, Fraction(1, 100), period=np.int32(6)).isel(orbit=1)
periodic_orbits(ball, Decimal("0.01"), np.uint8(3))
number: xr.DataArray = pseudorigid.residue(six)
line = trace_manifold(
    ball, 0.01, six, np.int64(0), side="inner", stable=True, length=Fraction(1, 2)
)
both = xr.concat([with_parameters(many), with_parameters(many)], "energy")
symmetric_orbits(ball, "0.01", 6)  # refused
symmetric_orbits(ball, 0.01, 6.0)  # refused
pseudorigid.residue(3)  # refused
trace_manifold(ball, 0.01, six, 0, False)  # refused
trace_manifold(ball, 0.01, six, side="left")  # refused
trace_manifold(ball, 0.01, six, saddle="0")  # refused
with_parameters(ball)  # refused

# Pictures, and the package.
picture = Picture(many["x"], -many["udot"], ("a", "b"), title="c")
picture.line(range(2), [0, 1], "label", color="red", lw=2)
picture.dots(column, column, "black")
picture.bars([0, 1], 0, [1, 2], color="red")
picture.note(0, 0, "text", (1, 2), ha="right", va="top")
picture.colorbar(["red", "blue"], 0, 1, "name")
picture.save(Path("a.png")).save("a.svg").figure.set_facecolor("red")
version: str = pseudorigid.__version__
Picture([0, 1])  # refused
Picture([0, 1], [0, 1], names="xy")  # refused
picture.dots([0, 1], [0, 1])  # refused
picture.dot([0, 1], [0, 1], "red")  # refused
picture.note(0, 0, "text", ha="top")  # refused
picture.render("gif")  # refused
picture.save(3)  # refused
_ = pseudorigid.orbits  # refused
