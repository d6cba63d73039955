# %% A portrait of another ball: a spherical shell; colours show the rotation number.
import numpy as np
from matplotlib import colormaps

from pseudorigid import Ball, Picture, classify_orbits, orbit

ball, hues = Ball(k=1 / 3, g=0.04), colormaps["inferno"](np.linspace(0.15, 0.67, 64))
starts = ball.start(np.linspace(-0.95, 0.95, 58), energy=0.004)
data, kinds = orbit(ball, starts, impacts=1500), classify_orbits(ball, starts)
x, y = data["x"], data["xdot"] - ball.k * data["udot"]
picture = Picture([-0.1, 0.45], y, ("$x$", "$y$"), "A shell, $k$ = 1/3, $g$ = 0.04, $E$ = 0.004")
for i, turns in enumerate(kinds["rotation_number"].values):
    regular = kinds["type"][i] == "regular"
    hue = hues[np.clip(int(64 * (turns - 0.165) / 0.03), 0, 63)] if regular else "silver"
    picture.dots(x[:, i], y[:, i], hue, 0.5)
picture.colorbar(hues, 0.165, 0.195, "turns per impact")
picture.save("portrait.png")
