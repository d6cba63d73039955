"""Run a command of ./reproduce."""

import os
import sys
from pathlib import Path

from ..command_list import DEFAULT_COMMAND, all_commands
from ..declaration import SourceError, imported
from ..records.files import memory_is_short
from . import arguments


def main(words: list[str]) -> int:
    """Run the command that the words name, by default `figures`, and return the exit status."""
    try:
        try:
            return _run(words)
        finally:
            sys.stdout.flush()  # an error that comes at the end of the process cannot be reported
    except BrokenPipeError:  # the reader has ended, for instance `| head`
        reason = None
    except SourceError as error:
        reason = memory_is_short(error) or str(error)
    except OSError as error:
        reason = f"{error.filename or 'cannot write to stdout'}: {error.strerror}"
    except Exception as error:
        if (reason := memory_is_short(error)) is None:
            raise
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if reason:
        print(f"reproduce: {reason}", file=sys.stderr)
    return 1


def _run(words: list[str]) -> int:
    """Run a command, and report errors that are meant for users."""
    args = arguments.read(words)
    # These imports take long: mistakes in the words are reported first.
    from ..config import ConfigError
    from ..records.files import FileError
    from ..records.provenance import ChangedError
    from ..records.sources import ROOT
    from .errors import UsageError, print_error
    from .running import set_environment

    try:
        args.start = Path.cwd()
        str(ROOT).encode()  # netCDF4 and snakemake need names that are text
    except FileNotFoundError:
        print_error("the current folder was deleted: go to another one")
        return 1
    except UnicodeEncodeError:
        print_error(f"{str(ROOT)!a}: this folder's name is not UTF-8: rename it")
        return 1
    os.chdir(ROOT)
    set_environment()
    command = all_commands().get(args.word, DEFAULT_COMMAND)
    try:
        if command.packages and not (command.runs_snakemake and args.makes_nothing):
            from .packages import add_packages

            add_packages(command.packages)
        module = command.module or f"pipeline.cli.commands.{args.word}"
        return int(imported(f"{module}.run")(args))
    except ConfigError as error:
        print(error, file=sys.stderr)
    except (UsageError, FileError, ChangedError) as error:
        print_error(str(error))
        return getattr(error, "status", 1)
    except KeyboardInterrupt:
        return 130
    return 1
