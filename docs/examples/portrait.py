# %% A portrait of another ball: a spherical shell; colours show the rotation number.
import numpy as np
from matplotlib import colormaps

from pseudorigid import Ball, Picture, classify_orbits, orbit

ball, hues = Ball(k=1 / 3, g=0.04), colormaps["inferno"]
starts = ball.start(np.linspace(-0.95, 0.95, 58), energy=0.004)
data, kinds = orbit(ball, starts, impacts=1500), classify_orbits(ball, starts)
x, y = data["x"], data["xdot"] - ball.k * data["udot"]
picture = Picture([-0.1, 0.45], y, ("$x$", "$y$"), "A shell, $k$ = 1/3, $g$ = 0.04, $E$ = 0.004")
for i, turns in enumerate(kinds["rotation_number"].values):
    hue = hues(18 * turns - 2.82) if kinds["type"][i] == "regular" else "silver"
    picture.dots(x[:, i], y[:, i], hue, 0.5)
for turns in np.linspace(0.165, 0.195, 181):
    picture.dots([0.36], [6 * turns - 1.08], hues(18 * turns - 2.82), 7, marker="s")
for turns in (0.165, 0.175, 0.185, 0.195):
    picture.note(0.36, 6 * turns - 1.08, f"{turns}", (7, 0))
picture.note(0.36, 0.11, "turns per impact", ha="center")
picture.save("portrait.png")
