"""The search for a certificate of each theorem: search.X.propose_Y for checkers.X.check_Y."""

from importlib import import_module

from .statements import THEOREMS


def search_certificate(name: str) -> str:
    """Search a new certificate of a theorem, which its checker has yet to prove.

    Parameters
    ----------
    name : str
        A key of THEOREMS.

    Returns
    -------
    str

    Examples
    --------
    >>> text = search_certificate("one-fixed-point")
    >>> THEOREMS["one-fixed-point"].check(text).verdict
    'proved'
    """
    theorem = THEOREMS[name]
    module = import_module(theorem.checker.__module__.replace(".checkers.", ".search."))
    propose = getattr(module, theorem.checker.__name__.replace("check", "propose"))
    return propose(theorem, **theorem.hints)
