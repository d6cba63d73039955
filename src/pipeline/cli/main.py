"""The command line: a word and its arguments, or the names of figures."""

import importlib
import os
import sys
from pathlib import Path

from . import arguments


def main(words: list[str]) -> int:
    """Run one word, or make figures; the exit status."""
    args = arguments.read(words)
    # What takes a while to import comes after what may be wrong with the words.
    from ..config import ConfigError
    from ..records.files import FileError
    from ..records.record import ChangedError
    from ..records.sources import ROOT
    from .session import UsageError, print_error, set_environment

    args.start = Path.cwd()
    os.chdir(ROOT)
    set_environment()
    word = arguments.COMMANDS.get(args.word, arguments.DEFAULT_COMMAND)
    try:
        module = importlib.import_module(
            f".commands.{word.module or args.word or 'figures'}", __package__
        )
        return module.run(args)
    except ConfigError as error:
        print(error, file=sys.stderr)
    except (UsageError, FileError, ChangedError) as error:
        print_error(str(error))
        return getattr(error, "status", 1)
    except BrokenPipeError:  # of a reader that has seen enough, as `| head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except KeyboardInterrupt:
        return 130
    return 1
