"""Parameters of slow tests."""

import pytest


def slowly(*values):
    """Mark values of a parameter as slow; a tuple holds the values of several parameters."""
    return [
        pytest.param(*(value if isinstance(value, tuple) else [value]), marks=pytest.mark.slow)
        for value in values
    ]
