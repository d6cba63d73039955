# %% A portrait of another ball: a spherical shell; colours show the rotation number.
import numpy as np
from matplotlib import colormaps

from pseudorigid import Ball, Picture, classify_orbits, orbit

ball = Ball(k=1 / 3, g=0.04)
starts = ball.start(np.linspace(-0.95, 0.95, 58), energy=0.004)
data, kinds = orbit(ball, starts, impacts=1500), classify_orbits(ball, starts)
x, y = data["x"], data["xdot"] - ball.k * data["udot"]
picture = Picture(x, y, ("$x$", "$y$"), "A shell, $k$ = 1/3, $g$ = 0.04, $E$ = 0.004")
for i, turns in enumerate(kinds["rotation_number"].values):
    hue = colormaps["turbo"](33 * turns - 5.45) if kinds["type"][i] == "regular" else "silver"
    picture.dots(x[:, i], y[:, i], hue, 0.5)
picture.save("portrait.png")
