"""The words of ./reproduce and their arguments: what --help prints, and what is refused.

It needs nothing but a Python of any age: before anything is installed `reproduce` asks it too.
"""

import argparse
import difflib
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
GO_ON = 75  # the exit status of `main` where the words are well as far as can be said
MISUSE = 2
OTHERS = ("paper", "all")  # names that are not in config.yaml
CERTIFICATES = "src/pseudorigid/proofs/certificates"

FIGURES = "figures to draw, by the names in config.yaml; all without a name"
SWEEPS = "sweeps of config.yaml; all without a name"
SLURM = "hand blocks of cells to Slurm, as workflow/profiles/slurm says"


class Word:
    """A word: the module in `words` behind it, its line in the list, and its arguments.

    `names` and `flags` are (name, arguments of argparse's add_argument) each. The options of one
    that `passes` on what it does not know go to snakemake, after its names.
    """

    def __init__(self, line, *names, module=None, flags=(), passes=False, more=""):
        self.line, self.names, self.flags = line, names, flags
        self.module, self.passes, self.more = module, passes, more


def _any(name, text):
    return name, {"nargs": "*", "help": text}


def _one(name, text):
    # argparse would refuse one that is missing; the word does, and says which there are
    return name, {"nargs": "?", "help": text, "metavar": name.upper()}


_SLURM = ("--slurm", {"action": "store_true", "help": SLURM})
WORDS = {
    "list": Word("every figure, chart and dataset that there can be, and the state of its file"),
    "variant": Word(
        "the figures of a variant of config.yaml, into results/NAME/figures/",
        _one("name", "a variant of config.yaml"),
        _any("figure", FIGURES),
        passes=True,
    ),
    "compare": Word(
        "what differs between two variants, figure by figure",
        _one("a", "a variant of config.yaml, or paper"),
        _one("b", "another one"),
        _any("figure", FIGURES),
        passes=True,
    ),
    "sweep": Word(
        "grids over k and E/g^2, into results/sweep/",
        _any("name", SWEEPS),
        flags=[_SLURM],
        passes=True,
    ),
    "atlas": Word(
        "their pictures, into more_figures/atlas/",
        _any("name", SWEEPS),
        module="sweep",
        flags=[_SLURM],
        passes=True,
    ),
    "study": Word(
        "speed and accuracy against other methods, into more_figures/study/",
        passes=True,
        more=" Installs the packages of its rivals first (once).",
    ),
    "claims": Word(
        "every statement of the paper, checked: CLAIMS.md, more_figures/claims/",
        flags=[
            ("--check", {"type": int, "metavar": "ID", "help": "judge one claim alone"}),
            (
                "--data",
                {
                    "metavar": "[NAME=]FILE",
                    "help": "a dataset to judge it by, in the place of that name (as in "
                    "fig2/orbits)",
                },
            ),
        ],
        passes=True,
        more=" What is missing is made first, the sweeps too.",
    ),
    "prove": Word(
        "the theorems, each checked from its certificate",
        _any("theorem", "theorems; all without a name"),
        flags=[
            ("--search", {"action": "store_true", "help": "make the certificates anew first"}),
            (
                "--impacts",
                {"action": "store_true", "help": "prove the impacts behind the figures instead"},
            ),
            (
                "--pictures",
                {"action": "store_true", "help": "draw the pictures, into more_figures/proofs/"},
            ),
        ],
        more=" Exit status 1 where one is not proved.",
    ),
    "report": Word(
        "one HTML page: figures, numbers beside the paper's, corrections, run times",
        passes=True,
    ),
    "archive": Word(
        "one tar with figures, data and what they were made from",
        ("file", {"nargs": "?", "help": "by default results/archive/pseudorigid.tar"}),
        more=" It is the same to the byte wherever its files are. Everything must be made.",
    ),
    "verify": Word(
        "whether everything here is as committed, and if not, what differs",
        flags=[
            (
                "--against",
                {
                    "metavar": "PLACE",
                    "help": "an archive: compare this tree with it, file by file; or a folder with "
                    "another tree or its results: say how many ulp lie between its data and these",
                },
            ),
            ("--strict", {"action": "store_true", "help": "exit 1 for notes too"}),
        ],
        more=" The layers are config, source, environment, data, drawing, file. Exit status 1 for "
        "other bytes and for results that this tree did not make; other differences are notes.",
    ),
    "accept": Word(
        "makes the figures as they are now the committed ones",
        more=" The study's charts too where they were made, and so on; it says what changed.",
    ),
    "clean": Word(
        "deletes results that were made; committed files stay",
        _any("name", "variants, or other folders of results/; all without a name"),
        flags=[("--yes", {"action": "store_true", "help": "do not ask"})],
    ),
    "benchmark": Word(
        "one table of ratios of speed, measured now",
        more=" Installs the packages of the study's rivals first (once).",
    ),
    "test": Word("the test suite (arguments go to pytest)"),
    "help": Word("this list, or the arguments of a WORD", _one("word", "one of these words")),
}
NO_WORD = Word(
    "Draw the paper's figures from config.yaml, those that are not current, into paper_figures/.",
    _any("figure", FIGURES + "; also files, such as results/paper/orbits_fig2.nc"),
    passes=True,
)
SETTINGS = ("--config", "-C", "--configfile", "--configfiles")  # snakemake's
SNAKEMAKE = "What follows from the first other option on goes to snakemake: --cores 2, -n, --dag."


class _Parser(argparse.ArgumentParser):
    """One that refuses in one line."""

    def error(self, message):
        unknown, text = message.partition("unrecognized arguments: ")[1:]
        if unknown:
            first = text.split()[0]
            options = [name for action in self._actions for name in action.option_strings]
            message = f"no argument {first}" + hint(first, options)
        refuse(message[0].lower() + message[1:], self.prog)


def read(arguments):
    """What a command line asks for, as argparse's namespace.

    It has the `word` (None where there is none), its names and flags, and `options`, those of
    snakemake or pytest. Help and mistakes end in SystemExit.
    """
    first, *rest = arguments or [""]
    if first == "help" and not rest:
        return read(["--help"])
    if first == "help" and not rest[0].startswith("-"):
        first, *surplus = rest
        rest = ["--help"]
        if first not in WORDS:
            refuse(f"no word {first}{hint(first, WORDS)}")
        if surplus:
            refuse(f"no argument {surplus[0]}", "./reproduce help")
    word = first if first in WORDS else None
    parser = _parser(word)
    if word == "test" and rest[:1] not in (["--help"], ["-h"]):
        return argparse.Namespace(word=word, options=rest)
    own, options = _split(WORDS.get(word, NO_WORD), rest if word else arguments)
    given = parser.parse_args(own)
    if not word and given.version:
        print(_versions())
        sys.exit(0)
    if any(option.partition("=")[0] in SETTINGS for option in options):
        refuse("--config and --configfile are not used here: edit config.yaml")
    given.word, given.options = word, options
    return given


def main(arguments):
    """Answer what needs no packages; else the exit status GO_ON.

    Names are looked for in the text of config.yaml: what is nowhere in it cannot be one. Theorems
    are called as their certificates; those of `clean` are folders.
    """
    given = read(arguments)
    try:
        text = (ROOT / "config.yaml").read_text(encoding="utf-8", errors="replace")
    except OSError:  # which is said when it is read in earnest
        return GO_ON
    words, keys = re.findall(r"[\w-]+", text), re.findall(r"^ *([\w-]+):", text, re.MULTILINE)
    theorems = [file.stem for file in (ROOT / CERTIFICATES).glob("*.toml")]
    for kind in () if given.word == "clean" else ("name", "a", "b", "figure", "theorem"):
        names = getattr(given, kind, None) or []
        for name in [names] if isinstance(names, str) else names:
            known = theorems if kind == "theorem" else [*words, *OTHERS]
            if "/" not in name and name not in known:
                near = theorems if kind == "theorem" else keys if given.word else [*keys, *WORDS]
                refuse(f"no {_kind(given.word, kind)} {name}{hint(name, near)}")
    return GO_ON


def _kind(word, argument):
    """What an argument is a name of."""
    if argument == "theorem":
        return argument
    if argument == "figure":
        return "figure" if word else "word or figure"
    return "sweep" if word in ("sweep", "atlas") else "variant"


def hint(name, known):
    """The end of a line about an unknown name: which was meant."""
    near = difflib.get_close_matches(str(name), list(known), 1, 0.6)
    return f": did you mean {near[0]}?" if near else ""


def refuse(message, program="./reproduce"):
    """End with one line about what was typed."""
    print(f"{program.replace('./', '', 1)}: {message}", file=sys.stderr)
    sys.exit(MISUSE)


def _split(word, arguments):
    """(names and flags of its own, what goes on to snakemake)."""
    if not word.passes:
        return arguments, []
    takes = {name: 0 if "action" in how else 1 for name, how in word.flags}
    takes.update({"-h": 0, "--help": 0, "--version": 0})
    end = next((i for i, a in enumerate(arguments) if a.startswith("-")), len(arguments))
    own, rest, options = list(arguments[:end]), list(arguments[end:]), []
    while rest:
        name, given, _ = rest[0].partition("=")
        size = 1 + (takes[name] if not given else 0) if name in takes else 1
        (own if name in takes else options).extend(rest[:size])
        del rest[:size]
    return own, options


def _parser(name):
    word = WORDS.get(name, NO_WORD)
    sentence = word.line if not name else f"{word.line[0].upper()}{word.line[1:]}.{word.more}"
    parser = _Parser(
        prog="./reproduce" + (f" {name}" if name else ""),
        description=sentence,
        formatter_class=argparse.RawDescriptionHelpFormatter
        if not name
        else argparse.HelpFormatter,
        epilog=_epilog(name, word),
        allow_abbrev=False,
    )
    for key, how in (*word.names, *word.flags):
        parser.add_argument(key, **how)
    if not name:
        text = "print the versions of this project and of snakemake"
        parser.add_argument("--version", action="store_true", help=text)
    return parser


def _epilog(name, word):
    if name:
        return SNAKEMAKE if word.passes else None
    width = max(map(len, WORDS))
    lines = [f"  {word:{width}}  {WORDS[word].line}" for word in WORDS]
    more = "./reproduce WORD --help has a word's arguments."
    return "\n".join(["words:", *lines, "", more, SNAKEMAKE])


def _versions():
    project, lock = (
        (ROOT / name).read_text(encoding="utf-8")
        for name in ("pyproject.toml", "requirements/lock.txt")
    )
    ours = re.search(r'^version = "(.+)"', project, re.MULTILINE).group(1)
    return f"pseudorigid {ours}, snakemake {re.search('^snakemake==([^ ;]+)', lock, re.M).group(1)}"
