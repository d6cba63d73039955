"""Matplotlib's own fonts alone.

Matplotlib has no setting that leaves out the fonts of the system, one of which could be another
version of its own. This file replaces its list of fonts for a while; a test fails where that has no
effect any more.
"""

from contextlib import contextmanager

import matplotlib
from matplotlib import font_manager


@contextmanager
def delivered():
    """Let matplotlib find the fonts that it is delivered with, and no others, in the body."""
    manager, own = font_manager.fontManager, matplotlib.get_data_path()
    found = manager.ttflist
    try:
        manager.ttflist = [font for font in found if font.fname.startswith(own)]
        manager._findfont_cached.cache_clear()
        yield
    finally:
        manager.ttflist = found
        manager._findfont_cached.cache_clear()
