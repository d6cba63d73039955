"""Progress of the sweeps of a run, in cells."""

import time

from pipeline.records.build_spec import BuildSpec

PAUSE = 1.0  # least number of seconds between two lines


class Cells:
    """Count the cells of the sweeps of which a run makes blocks.

    `specs` maps results to build specifications, and `outdated` holds the results of the run.
    """

    def __init__(self, specs: dict[str, BuildSpec], outdated: set[str]) -> None:
        blocks = {path: spec for path, spec in specs.items() if spec.step.startswith("block")}
        cells = {path: len(block.config["cells"]) for path, block in blocks.items()}
        self.left: dict[str, tuple[int, int]] = {}  # block -> its cells and impacts
        for path in blocks.keys() & outdated:
            config = blocks[path].config
            self.left[path] = cells[path], cells[path] * config["starts"] * config["impacts"]
        scenes = {blocks[path].scene for path in self.left}
        self.total = sum(cells[path] for path in blocks if blocks[path].scene in scenes)
        self.first: tuple[float, int, int] | None = None  # time, cells and impacts left
        self.printed = -PAUSE

    def done(self, path: str) -> str | None:
        """Take a block as done, and return the line to print, if it is time for one.

        Speed is measured from the first block on: before it, jobs may compile the map.
        """
        self.left.pop(path, None)
        now = time.monotonic()
        cells, impacts = (sum(block[i] for block in self.left.values()) for i in range(2))
        since, self.first = self.first, self.first or (now, cells, impacts)
        if cells and now < self.printed + PAUSE:
            return None
        self.printed = now
        return line(self.total, (cells, impacts), now, since)


def line(
    total: int, left: tuple[int, int], now: float, first: tuple[float, int, int] | None = None
) -> str:
    """Describe the progress of sweeps of `total` cells.

    `left` counts cells and impacts still to be done, and `first` is an earlier time in seconds with
    the cells and impacts that were left then.
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
