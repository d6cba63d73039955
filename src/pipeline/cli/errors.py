"""Errors that end a command in one line for the user."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from ..records.sources import ROOT


class UsageError(Exception):
    """One line for the user, which ends the run with the exit status `status`."""

    status = 1


class CommandLineError(UsageError):
    """One line about a mistake in the command line."""

    status = 2


@contextmanager
def one_line(prefix: str = "", kind: type[Exception] = ValueError) -> Iterator[None]:
    """Turn an error of this kind, whose message is for users, into a UsageError."""
    try:
        yield
    except kind as error:
        raise UsageError(prefix + str(error).replace(f"{ROOT}/", "")) from None


def print_error(line: str) -> None:
    """Print a line for the user to stderr."""
    sys.stdout.flush()  # keeps the order of lines if both streams go to one pipe
    print(f"reproduce: {line}", file=sys.stderr, flush=True)
