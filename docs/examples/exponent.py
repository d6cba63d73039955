# %% The largest Lyapunov exponent of the chaotic sea, with its error.
import numpy as np

from pseudorigid import Ball, Picture, lyapunov_spectrum

ball = Ball(k=0.2, g=0.04)
starts = ball.start(np.linspace(0.55, 0.68, 32), energy=0.01)
runs = lyapunov_spectrum(ball, starts, impacts=50_000, records=50)["exponent"].max("index")
mean, error = runs.mean("orbit"), runs.std("orbit", ddof=1) / 32**0.5
title = rf"Mean of 32 orbits: {mean[-1]:.4f} $\pm$ {error[-1]:.4f} (standard error)"
picture = Picture([0, 50_000], [0.2, 0.26], ("Impacts", "Largest exponent, nats per impact"), title)
for i in runs["orbit"]:
    picture.line(runs["impact"], runs[:, i], color="silver", lw=0.35)
picture.estimates(runs["impact"], mean, mean - error, mean + error, "#0072b2")
picture.save("exponent.png")
