# %% One scan of the atlas: the regular share of the section over the energy.
import numpy as np

from extensions.atlas.cell import numbers_of_cells
from pseudorigid import Picture

energies = np.linspace(0.25, 20, 80)  # E/g^2
picture = Picture([0, 20], [0, 1], ("$E/g^2$", "Regular share"), "Two balls; bars: 95 %")
# %%
for k, label, hue in ((1 / 5, "solid ball", "#d55e00"), (1 / 3, "shell", "#123fb0")):
    cells = [(k, e) for e in energies]
    found = numbers_of_cells(cells, starts=300, impacts=4000)
    share, low, high = ([cell[f"regular{end}"] for cell in found] for end in ("", "_low", "_high"))
    picture.bars(energies, low, high, color=hue, lw=0.8)
    picture.dots(energies, share, hue, 2.2, label)
picture.save("scan.png")
