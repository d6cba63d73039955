"""Interleaved timing: calls take turns, so that what slows a machine down slows all of them."""

import statistics
import time
from collections.abc import Callable, Mapping


def interleaved(
    calls: Mapping[str, Callable[[], object]],
    repetitions: int,
    clock: Callable[[], float] = time.process_time,
) -> dict[str, tuple[float, float, float]]:
    """Return median, lowest and highest seconds of each call.

    Every call is made once before, so that it compiles. `clock` counts the seconds of this process;
    use time.perf_counter for calls whose work other processes do.
    """
    for call in calls.values():
        call()
    seconds = {name: [] for name in calls}
    for _ in range(repetitions):
        for name, call in calls.items():
            begin = clock()
            call()
            seconds[name].append(clock() - begin)
    return {name: (statistics.median(s), min(s), max(s)) for name, s in seconds.items()}
