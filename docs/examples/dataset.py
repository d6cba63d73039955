# %% A dataset of the workflow, results/paper/orbits_fig2.nc: run ./reproduce first.
import numpy as np
import xarray as xr
from matplotlib import colormaps

from pseudorigid import Picture

data = xr.load_dataset("results/paper/orbits_fig2.nc")  # the orbits, one after another
starts = np.cumsum(data["row_size"].values)[:-1]
orbits = np.split(np.array([data["x"], data["tau"]]), starts, axis=1)
# %% The last orbit, in grey, fills the chaotic sea; the others lie on curves and islands.
picture = Picture(data["x"], data["tau"], ("$x$", "Time since the previous impact"), "Figure 2")
hues = [*colormaps["inferno"](np.arange(36, 173, 22)), "silver"]
for (x, time), hue in reversed(list(zip(orbits, hues, strict=True))):
    picture.dots(x, time, hue, 0.6)
picture.save("dataset.png")
