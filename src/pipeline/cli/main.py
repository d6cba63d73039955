"""Run a command of ./reproduce."""

import os
import sys
from pathlib import Path

from ..command_list import DEFAULT_COMMAND, all_commands
from ..declaration import SourceError, imported
from ..records.files import FileError, memory_is_short
from ..records.sources import ROOT
from . import arguments
from .errors import UsageError, print_error
from .running import set_environment


def main(words: list[str]) -> int:
    """Run the command that the words name, by default `figures`, and return the exit status.

    Errors that are meant for users become a line on stderr.
    """
    reason, status = None, 1
    try:
        try:
            return _run(arguments.read(words))
        finally:
            sys.stdout.flush()  # an error that comes at the end of the process cannot be reported
    except KeyboardInterrupt:
        return 130
    except (UsageError, FileError, SourceError) as error:
        reason, status = memory_is_short(error) or str(error), getattr(error, "status", 1)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the last flush
        if not isinstance(error, BrokenPipeError):  # the reader has ended, for instance `| head`
            reason = f"{error.filename or 'cannot write to stdout'}: {error.strerror}"
    except Exception as error:
        if not (reason := memory_is_short(error)):
            from ..config import ConfigError  # takes long: no mistake in the words waits for it

            if not isinstance(error, ConfigError):
                raise
            print(error, file=sys.stderr)
    if reason:
        print_error(reason)
    return status


def _run(args: arguments.Arguments) -> int:
    """Run a command in the root, with the packages that it needs."""
    try:
        args.start = Path.cwd()
    except FileNotFoundError:
        raise UsageError("the current folder was deleted: go to another one") from None
    os.chdir(ROOT)
    set_environment()
    command = all_commands().get(args.word, DEFAULT_COMMAND)
    makes = not (command.runs_snakemake and args.makes_nothing)
    lists = [command.packages] if command.packages and makes else []
    lists += ["report"] * ("--report" in {option.partition("=")[0] for option in args.options})
    if lists:
        from .packages import add_packages

        add_packages(*lists)
    module = command.module or f"pipeline.cli.commands.{args.word}"
    return int(imported(f"{module}.run")(args))
