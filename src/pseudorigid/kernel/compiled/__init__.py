"""Compilation with strict arithmetic, one thread, and machine code that is kept."""


def jit(function):
    """Compile a function on its first call, with strict arithmetic and without the GIL.

    Without fastmath and parallel, every + - * / and sqrt is rounded once, in the order written.
    error_model="numpy" makes 1/0 infinite instead of an exception.
    """
    import numba  # slow to import, and every start of the pipeline imports this package

    from .locator import Locator

    previous = numba.config.CACHE_LOCATOR_CLASSES
    numba.config.CACHE_LOCATOR_CLASSES = f"{Locator.__module__}.{Locator.__name__}"
    keep = Locator.keeps(function)
    try:
        return numba.njit(cache=keep, error_model="numpy", fastmath=False, nogil=True)(function)
    finally:
        numba.config.CACHE_LOCATOR_CLASSES = previous
