"""The one way a function is compiled: strict arithmetic, one thread, machine code that is kept.

Numba notices an edit of the file a function stands in, but not of the files it calls into, and
takes a comment for an edit; so `locator` says where machine code is kept.
"""


def jit(function):
    """Compile a function on its first call, with strict arithmetic.

    No fastmath, no parallel: every + - * / and sqrt is rounded once, in the order written.
    error_model="numpy" turns 1/0 into inf, as the processor does, instead of a Python exception.

    Parameters
    ----------
    function : callable
        Of numbers, tuples and arrays, in the part of Python that numba compiles.

    Returns
    -------
    callable
        The same, compiled for each set of argument types, without the interpreter's lock.
    """
    import numba  # takes long, and `meaning` is part of every start

    from .locator import Locator

    others = numba.config.CACHE_LOCATOR_CLASSES
    numba.config.CACHE_LOCATOR_CLASSES = f"{Locator.__module__}.{Locator.__name__}"
    kept = Locator.keeps(function)
    try:
        return numba.njit(cache=kept, error_model="numpy", fastmath=False, nogil=True)(function)
    finally:
        numba.config.CACHE_LOCATOR_CLASSES = others
