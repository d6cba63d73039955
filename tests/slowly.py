"""Parameters of tests that .ci/run runs and the default suite leaves out."""

import pytest


def slowly(*values):
    """Further values of a parameter; a tuple stands for several parameters."""
    return [
        pytest.param(*(value if isinstance(value, tuple) else [value]), marks=pytest.mark.slow)
        for value in values
    ]
