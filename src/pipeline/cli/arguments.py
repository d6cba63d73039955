"""The words of ./reproduce and their arguments: what --help prints, and what is refused.

It needs nothing but Python 3.6 or newer: before anything is installed `reproduce` asks it too.
"""

import argparse
import difflib
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
VALID_SO_FAR = 75  # the exit status of `main` where the words are well as far as can be said
USAGE_STATUS = 2
OTHERS = ("paper", "all")  # names that are not in config.yaml
CERTIFICATES = "src/pseudorigid/proofs/certificates"

FIGURES = "figures to draw, by the names in config.yaml; all without a name"
DATA = "a dataset to judge it by, in the place of that name (as in fig2/orbits)"
AGAINST = "an archive, or a folder with one unpacked or another tree: compare file by file with it"


class Command:
    """A word: its line in the list, its arguments, and the module in `words` behind it.

    `arguments` are (name, arguments of argparse's add_argument) each.
    """

    passes = False

    def __init__(self, line, *arguments, module=None, more=""):
        self.line, self.arguments, self.module, self.more = line, arguments, module, more


class SnakemakeCommand(Command):
    """One that runs snakemake: options that it does not know go there, after its names."""

    passes = True


def _any(name, text):
    return name, {"nargs": "*", "help": text}


def _one(name, text, metavar=None):
    return name, {"nargs": "?", "help": text, "metavar": metavar or name.upper()}


# Arguments that must be given. argparse would only say that one is missing: the word itself
# refuses, and says which names there are.
REQUIRED = ("variant", "a", "b")


def _switch(name, text):
    return name, {"action": "store_true", "help": text}


_SWEPT = (
    _any("sweep", "sweeps of config.yaml; all without a name"),
    _switch("--slurm", "hand blocks of cells to Slurm, as profiles/slurm says"),
)
COMMANDS = {
    "list": Command("every figure, chart and dataset that there can be, and the state of its file"),
    "variant": SnakemakeCommand(
        "the figures of a variant of config.yaml, into results/NAME/figures/",
        _one("variant", "a variant of config.yaml", "NAME"),
        _any("figure", FIGURES),
    ),
    "compare": SnakemakeCommand(
        "what differs between two variants, figure by figure",
        _one("a", "a variant of config.yaml, or paper"),
        _one("b", "another one"),
        _any("figure", "figures to compare, by the names in config.yaml; all without a name"),
        _switch("--all", "a line for each variable and each orbit that differs"),
    ),
    "sweep": SnakemakeCommand("grids over k and E/g^2, into results/sweep/", *_SWEPT),
    "atlas": SnakemakeCommand("their pictures, into more_figures/atlas/", *_SWEPT, module="sweep"),
    "study": SnakemakeCommand(
        "speed and accuracy against other methods, into more_figures/study/",
        more=" Installs the packages of its rivals first (once).",
    ),
    "claims": SnakemakeCommand(
        "every statement of the paper, checked: CLAIMS.md, more_figures/claims/",
        ("--check", {"type": int, "metavar": "ID", "help": "judge one claim alone"}),
        ("--data", {"metavar": "[NAME=]FILE", "help": DATA}),
        more=" What is missing is made first, the sweeps too.",
    ),
    "prove": Command(
        "the theorems, each checked from its certificate",
        _any("theorem", "theorems; all without a name"),
        _switch("--search", "make the certificates anew first"),
        _switch("--impacts", "prove the impacts behind the figures instead"),
        _switch("--pictures", "draw the pictures, into more_figures/proofs/"),
        more=" Exit status 1 where one is not proved.",
    ),
    "report": SnakemakeCommand(
        "one HTML page: figures, numbers beside the paper's, corrections, run times"
    ),
    "archive": Command(
        "one tar with figures, data and what they were made from",
        ("file", {"nargs": "?", "help": "by default results/archive/pseudorigid.tar"}),
        more=" It is the same to the byte wherever its files are. Everything must be made.",
    ),
    "verify": Command(
        "whether everything here is as committed, and if not, what differs",
        ("--against", {"metavar": "PLACE", "help": AGAINST}),
        _switch("--strict", "exit 1 for notes too"),
        more=" The layers are config, source, environment, data, drawing, file. Exit status 1 for "
        "other bytes and for results that this tree did not make; other differences are notes.",
    ),
    "accept": Command(
        "makes the figures as they are now the committed ones",
        more=" The study's charts too where they were made, and so on; it says what changed.",
    ),
    "clean": Command(
        "deletes results that were made; committed files stay",
        _any("folder", "variants, or other folders of results/; all without a name"),
        _switch("--yes", "do not ask"),
    ),
    "benchmark": Command(
        "one table of ratios of speed, measured now",
        more=" Installs the packages of the study's rivals first (once).",
    ),
    "test": Command(
        "the test suite (arguments go to pytest)",
        more=" Installs the packages of the tests first (once).",
    ),
    "help": Command("this list, or the arguments of a WORD", _one("word", "one of these words")),
}
DEFAULT_COMMAND = SnakemakeCommand(
    "Draw the paper's figures from config.yaml, those that are not current, into paper_figures/.",
    _any("figure", f"{FIGURES}; also files, such as results/paper/orbits_fig2.nc"),
    _switch("--version", "print the versions of this project and of snakemake"),
)
SETTINGS = ("--config", "-C", "--configfile", "--configfiles")  # snakemake's
OFFLINE = "./reproduce --offline DIR ... installs packages from a folder, without a network."
SNAKEMAKE = "What follows from the first other option on goes to snakemake: --cores 2, -n, --dag."


class Arguments(argparse.Namespace):
    """A command line: names and flags of its `word` (None where there is none), and `options`.

    These are for snakemake or pytest.
    """

    @property
    def checked(self):
        """The checked config.yaml."""
        if "config" not in self:
            from ..config import load  # not before packages are there

            self.config = load(ROOT / "config.yaml")
        return self.config


class _Parser(argparse.ArgumentParser):
    """One that refuses in one line."""

    def error(self, message):
        message = explained(self, message)
        refuse(message[0].lower() + message[1:], self.prog)


def read(arguments):
    """What a command line asks for; help and mistakes end in SystemExit."""
    first, *rest = arguments or [""]
    word = first if first in COMMANDS else None
    if word == "test" and rest[:1] not in (["--help"], ["-h"]):
        return Arguments(word=word, options=rest)
    own, options = _split(COMMANDS.get(word, DEFAULT_COMMAND), rest if word else arguments)
    if not word and {"-h", "--help"} & set(own):
        _refuse_unknown("figure", [name for name in own if not name.startswith("-")])
    given = _parser(word).parse_args(own, Arguments())
    if word == "help":
        if given.word not in (None, *COMMANDS):
            refuse(f"no word {given.word}{hint(given.word, COMMANDS)}")
        return read(["--help"] if given.word is None else [given.word, "--help"])
    if not word and given.version:
        print(_versions())
        sys.exit(0)
    if any(option.partition("=")[0] == "--offline" for option in options):
        refuse("--offline DIR comes first: ./reproduce --offline DIR ...")
    if any(option.partition("=")[0] in SETTINGS for option in options):
        refuse("--config and --configfile are not used here: edit config.yaml")
    given.word, given.options = word, options
    return given


def main(arguments):
    """Answer what needs no packages; else the exit status GO_ON.

    Names are looked for in the text of config.yaml: what is nowhere in it cannot be one. Theorems
    are called as their certificates.
    """
    given = read(arguments)
    for argument in ("variant", "a", "b", "sweep", "figure", "theorem"):
        names = getattr(given, argument, None) or []
        _refuse_unknown(argument, [names] if isinstance(names, str) else names, given.word)
    return VALID_SO_FAR


def _refuse_unknown(argument, names, word=None):
    """Refuse the first name that is nowhere in config.yaml's text and so cannot be meant."""
    config = ROOT / "config.yaml"
    if not config.is_file():  # reading a FIFO would wait for ever
        return
    try:
        text = config.read_text(encoding="utf-8", errors="replace")
    except OSError:  # which is said when it is read in earnest
        return
    words, keys = re.findall(r"[\w-]+", text), re.findall(r"^ *([\w-]+):", text, re.MULTILINE)
    known, near = [*words, *OTHERS], keys if word else [*keys, *COMMANDS]
    if word == "prove":
        known = near = [file.stem for file in (ROOT / CERTIFICATES).glob("*.toml")]
    kinds = {"a": "variant", "b": "variant", "figure": "figure" if word else "word or figure"}
    for name in names:
        if "/" not in name and name not in known:
            refuse(f"no {kinds.get(argument, argument)} {name}{hint(name, near)}")


def explained(parser, message):
    """What a parser finds wrong; of an unknown argument, which was meant."""
    unknown = message.partition("unrecognized arguments: ")[2]
    if not unknown:
        return message
    first = unknown.split()[0]
    if first.startswith("-"):
        first = first.partition("=")[0]
    known = [name for action in parser._actions for name in action.option_strings]
    return f"no argument {first}{hint(first, known)}"


def hint(name, known):
    """The end of a line about an unknown name: the nearest names, where some are near."""
    near = difflib.get_close_matches(str(name), list(dict.fromkeys(known)), 20, 0.6)
    if not near:
        return ""

    def ratio(other):
        return difflib.SequenceMatcher(None, other, str(name)).ratio()

    best = sorted(other for other in near if ratio(other) == ratio(near[0]))
    return f": did you mean {' or '.join(filter(None, [', '.join(best[:-1]), best[-1]]))}?"


def refuse(message, program="./reproduce"):
    """End with one line about what was typed."""
    print(f"{program.replace('./', '', 1)}: {message}", file=sys.stderr)
    sys.exit(USAGE_STATUS)


def _split(word, arguments):
    """(names and flags of its own, what goes on to snakemake)."""
    if not word.passes:
        return arguments, []
    # Flag -> how many arguments it takes.
    takes = {name: int("action" not in how) for name, how in word.arguments if name[0] == "-"}
    takes.update({"-h": 0, "--help": 0, "--version": 0})
    own, rest = [], list(arguments)
    while rest and not rest[0].startswith("-"):
        own.append(rest.pop(0))
    options = []
    while rest:
        name, given, _ = rest[0].partition("=")
        size = 1 if given else 1 + takes.get(name, 0)
        (own if name in takes else options).extend(rest[:size])
        del rest[:size]
    return own, options


def _parser(name):
    word = COMMANDS.get(name, DEFAULT_COMMAND)
    if name:
        line = f"{word.line[0].upper()}{word.line[1:]}.{word.more}"
        parser = _Parser(f"./reproduce {name}", description=line, allow_abbrev=False)
        parser.epilog = SNAKEMAKE if word.passes else None
    else:
        as_it_stands = argparse.RawDescriptionHelpFormatter
        parser = _Parser("./reproduce", formatter_class=as_it_stands, allow_abbrev=False)
        parser.description = word.line
        width = max(map(len, COMMANDS))
        lines = [f"  {word:{width}}  {COMMANDS[word].line}" for word in COMMANDS]
        more = "./reproduce WORD --help has a word's arguments."
        parser.epilog = "\n".join(["words:", *lines, "", more, OFFLINE, SNAKEMAKE])
    for key, how in word.arguments:
        parser.add_argument(key, **how)
    usage = parser.format_usage().partition(": ")[2].strip()
    for metavar in [how["metavar"] for key, how in word.arguments if key in REQUIRED]:
        usage = usage.replace(f"[{metavar}]", metavar)
    parser.usage = usage
    return parser


def _versions():
    def found(pattern, file):
        return re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE)[1]

    ours = found(r'^version = "(.+)"', "pyproject.toml")
    return f"pseudorigid {ours}, snakemake {found('^snakemake==([^ ;]+)', 'requirements/lock.txt')}"
