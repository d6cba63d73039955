"""How far the sweeps of a run are, by the cells of the blocks that are done."""

import time

PAUSE = 1.0  # seconds between two lines, at least


class Cells:
    """The cells of the sweeps of which a run makes blocks.

    Parameters
    ----------
    specs : dict
        Result -> BuildSpec.
    outdated : set of str
        The results that the run makes.
    """

    def __init__(self, specs, outdated):
        blocks = {path: each for path, each in specs.items() if each.step.startswith("block")}
        self.left = {
            path: (len(block.config["cells"]), _impacts(block.config))
            for path, block in blocks.items()
            if path in outdated
        }
        scenes = {blocks[path].scene for path in self.left}
        self.total = sum(len(b.config["cells"]) for b in blocks.values() if b.scene in scenes)
        self.first = None  # the time of the first block, and the cells and impacts left then
        self.told = -PAUSE

    def done(self, path):
        """Take a block as done; the line to print now, or None.

        The speed is measured from the first block on: before it, jobs may compile the map.
        """
        self.left.pop(path, None)
        now = time.monotonic()
        cells, impacts = (sum(block[i] for block in self.left.values()) for i in range(2))
        since, self.first = self.first, self.first or (now, cells, impacts)
        if cells and now < self.told + PAUSE:
            return None
        self.told = now
        return line(self.total, (cells, impacts), now, since)


def line(total, left, now, first=None):
    """How far sweeps of `total` cells are.

    Parameters
    ----------
    total : int
    left : (int, int)
        Cells and impacts that are still to be done.
    now : float
        The time in seconds.
    first : (float, int, int), optional
        An earlier time, and what was left then.

    Returns
    -------
    str
    """
    text = f"sweep: {total - left[0]:,} of {total:,} cells"
    if first is None:
        return text
    seconds = max(now - first[0], 1e-3)
    text += f", {(first[1] - left[0]) / seconds:.3g} cells/s"
    if not left[0]:
        return text
    minutes, rest = divmod(round(left[1] * seconds / (first[2] - left[1])), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{text}, {f'{hours} h {minutes} min' if hours else f'{minutes} min {rest} s'} to go"


def _impacts(block):
    return len(block["cells"]) * block["starts"] * block["impacts"]
