"""The command line: a word and its arguments, or what goes to snakemake."""

import difflib
import importlib
import os
import sys
from pathlib import Path

from ..config import ConfigError
from ..records.files import FileError
from ..records.sources import ROOT
from .folder import UsageError, say, set_environment

# word -> (module, what it does)
WORDS = {
    "test": ("test", "the test suite (arguments go to pytest)"),
    "verify": ("verify", "whether everything here is as committed, and if not, what differs"),
    "accept": ("accept", "makes the figures as they are now the committed ones"),
    "variant": ("variant", "the figures of a variant of config.yaml"),
    "compare": ("compare", "what differs between two variants, figure by figure"),
    "report": ("report", "one HTML page with the figures, numbers, corrections and run times"),
    "archive": ("archive", "one tar with figures, data and what they were made from"),
    "sweep": ("sweep", "grids over k and E/g^2, into results/sweep/"),
    "atlas": ("sweep", "their pictures, into more_figures/atlas/"),
    "claims": ("claims", "every statement of the paper, checked: CLAIMS.md"),
    "prove": ("prove", "the theorems, each checked from its certificate"),
    "study": ("study", "speed and accuracy against other methods, into more_figures/study/"),
    "benchmark": ("benchmark", "one table of ratios of speed, measured now"),
}


def main(arguments: list[str]) -> int:
    """Run one word, or make figures; the exit status."""
    start = Path.cwd()
    os.chdir(ROOT)
    set_environment()
    word, *rest = arguments or [""]
    try:
        if word in WORDS:
            module = importlib.import_module(f".words.{WORDS[word][0]}", __package__)
            return module.run(word, rest, start)
        meant = difflib.get_close_matches(word, WORDS, 1, 0.75)
        if meant:
            raise UsageError(f"no word {word}: did you mean {meant[0]}?")
        return importlib.import_module(".words.figures", __package__).run(word, arguments, start)
    except ConfigError as error:
        print(error, file=sys.stderr)
    except (UsageError, FileError) as error:
        say(str(error))
    except BrokenPipeError:  # of a reader that has seen enough, as `| head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except KeyboardInterrupt:
        return 130
    return 1
