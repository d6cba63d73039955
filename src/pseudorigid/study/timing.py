"""Calls timed in turn, so that what slows a machine down slows all of them."""

import statistics
import time


def interleaved(calls, repetitions, clock=time.process_time):
    """How long each of some calls takes.

    Parameters
    ----------
    calls : dict of str to callable
        Called once, so that they compile, then all once before any again.
    repetitions : int
    clock : callable
        Seconds: of this process alone, or time.perf_counter where others do the work.

    Returns
    -------
    dict
        Name -> (median, lowest, highest) of the seconds.
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
