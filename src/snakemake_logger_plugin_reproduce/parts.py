"""Progress of datasets whose parts, called blocks, are each computed by a job of its own."""

import time

from pipeline.records.build_spec import BuildSpec

PAUSE = 1.0  # least number of seconds between two lines


class Parts:
    """Counts the finished parts of the datasets that a run makes, and estimates the time left.

    `specs` maps results to build specifications, and `outdated` has the results of the run.
    """

    def __init__(self, specs: dict[str, BuildSpec], outdated: set[str]) -> None:
        scenes = {path: spec.scene for path, spec in specs.items() if is_part(spec)}
        self.left = scenes.keys() & outdated
        self.names = sorted({scenes[path] for path in self.left})
        self.total = sum(scene in self.names for scene in scenes.values())
        self.first: tuple[float, int] | None = None  # time, and parts that were left then
        self.printed = -PAUSE

    def done(self, path: str) -> str | None:
        """Count a finished part, and return a line if it is time for one.

        Speed is measured from the first part on: before it, jobs may compile the map.
        """
        self.left.discard(path)
        now, left = time.monotonic(), len(self.left)
        since, self.first = self.first, self.first or (now, left)
        if left and now < self.printed + PAUSE:
            return None
        self.printed = now
        text = f"{', '.join(self.names)}: {self.total - left:,} of {self.total:,} blocks"
        if since is None or not left:
            return text
        seconds = left * (now - since[0]) / max(since[1] - left, 1)
        return f"{text}, {_duration(round(seconds))} to go"


def is_part(spec: BuildSpec) -> bool:
    """Return whether a result is a part of a dataset."""
    return spec.step.startswith("block ")


def _duration(seconds: int) -> str:
    """Return a time in minutes and seconds, or in hours and minutes."""
    minutes, rest = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
