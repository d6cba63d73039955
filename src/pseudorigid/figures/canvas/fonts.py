"""Restrict matplotlib to the fonts that it ships with.

Matplotlib has no setting that leaves out the fonts of the system, which may hold another version of
a shipped font. A private attribute is used instead; a test fails if it stops having an effect.
"""

from contextlib import contextmanager

import matplotlib
from matplotlib import font_manager


@contextmanager
def shipped_only():
    """Let matplotlib find only the fonts that it ships with."""
    manager, folder = font_manager.fontManager, matplotlib.get_data_path()
    all_fonts = manager.ttflist
    try:
        manager.ttflist = [font for font in all_fonts if font.fname.startswith(folder)]
        manager._findfont_cached.cache_clear()
        yield
    finally:
        manager.ttflist = all_fonts
        manager._findfont_cached.cache_clear()
