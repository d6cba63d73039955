"""The commands of ./reproduce: their arguments, their help, and refusals of mistakes.

`reproduce` prints its help before anything is installed: only the standard library is used here.
"""

import argparse
import re
import sys
from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from ..records.names import suggestion

ROOT = Path(__file__).resolve().parents[3]
USAGE_STATUS = 2
# Options with which snakemake makes nothing.
_PRINTS = {
    *("-n", "--dry-run", "--dryrun", "--dag", "--rulegraph", "--filegraph", "--d3dag", "--lint"),
    *("-l", "--list", "--list-rules", "--lt", "--list-target-rules", "--lc", "--list-changes"),
    *("-S", "--summary", "-D", "--detailed-summary", "-t", "--touch", "--unlock"),
    *("-v", "--version", "-h", "--help"),
}


class Command:
    """A command: its line in the list of commands, its arguments and its module in `commands`.

    Each argument is a name with the keyword arguments of argparse's add_argument.
    """

    def __init__(
        self,
        line: str,
        *arguments: tuple[str, dict[str, Any]],
        module: str | None = None,
        details: str = "",
        runs_snakemake: bool = False,
    ) -> None:
        self.line, self.arguments, self.module = line, arguments, module
        self.details, self.runs_snakemake = details, runs_snakemake


# Such a command also reads -n and --cores, and what follows -- goes to snakemake.
SnakemakeCommand = partial(Command, runs_snakemake=True, module="figures")


def _names(name: str, text: str) -> tuple[str, dict[str, Any]]:
    return name, {"nargs": "*", "help": text}


def _name(name: str, text: str, metavar: str | None = None) -> tuple[str, dict[str, Any]]:
    return name, {"nargs": "?", "help": text, "metavar": metavar or name.upper()}


def _switch(name: str, text: str) -> tuple[str, dict[str, Any]]:
    return name, {"action": "store_true", "help": text}


# Required arguments that argparse treats as optional: without one, the command itself lists the
# possible names.
REQUIRED = ("variant", "a", "b")
_FIGURES = "figures to draw, by their names in config.yaml; without a name, all"
_SWEEPS = (
    _names("sweep", "sweeps of config.yaml; without a name, all"),
    _switch("--slurm", "submit blocks of cells to Slurm, with the options in profiles/slurm"),
)
COMMANDS = {
    "list": Command("every figure, chart and dataset that can be made, and the state of its file"),
    "variant": SnakemakeCommand(
        "make the figures of a variant of config.yaml, in results/NAME/figures/",
        _name("variant", "a variant of config.yaml", "NAME"),
        _names("figure", _FIGURES),
    ),
    "compare": SnakemakeCommand(
        "show what differs between two variants, figure by figure",
        _name("a", "a variant of config.yaml, or paper"),
        _name("b", "another one"),
        _names("figure", "figures to compare, by their names in config.yaml; without a name, all"),
        module="compare",
    ),
    "sweep": SnakemakeCommand("compute grids over k and E/g^2, in results/sweep/", *_SWEEPS),
    "atlas": SnakemakeCommand("draw these grids, in more_figures/atlas/", *_SWEEPS),
    "study": SnakemakeCommand(
        "compare speed and accuracy with other methods, in more_figures/study/",
        details=" Installs the packages of the other methods first (once).",
    ),
    "claims": SnakemakeCommand(
        "check every statement of the paper: CLAIMS.md, more_figures/claims/",
        module="claims",
        details=" Makes missing results first, including the sweeps.",
    ),
    "families": SnakemakeCommand(
        "follow periodic orbits from birth to end: more_figures/families/",
        details=" Takes minutes; a killed search continues.",
    ),
    "prove": SnakemakeCommand(
        "check the theorems from their certificates",
        _names("theorem", "theorems; without a name, all"),
        _switch("--again", "check them all, also those that did not change"),
        _switch("--search", "search for new certificates first"),
        _switch("--impacts", "prove the impacts behind the figures instead"),
        _switch("--pictures", "draw the pictures, in more_figures/proofs/"),
        module="prove",
        details=" Checks what changed since it was checked here, and prints a line for each "
        "theorem. The exit status is 1 if one is not proved.",
    ),
    "report": SnakemakeCommand(
        "write one HTML page: figures, numbers beside the paper's, corrections, run times",
        module="report",
    ),
    "explore": Command(
        "write a page that computes orbits in a browser, with the same bits, and open it",
        _switch("--no-open", "only write results/explorer.html"),
    ),
    "archive": Command(
        "write one tar with the figures, the data and what they were made from",
        ("file", {"nargs": "?", "help": "by default results/archive/pseudorigid.tar"}),
        _switch("--with-packages", "add the sources and the locked packages: runs offline"),
        ("--python", {"metavar": "X.Y", "help": "of these packages; by default the present one"}),
        details=" The same results give the same bytes. All results must be current.",
    ),
    "article": Command(
        "set the replication article, results/article.pdf, from current results",
        details=" Installs the typesetter first (once).",
    ),
    "site": SnakemakeCommand(
        "write one folder to mail or serve: report, explorer and article, in results/site/",
        module="site",
        details=" All published files must be the committed ones. Installs the typesetter first "
        "(once).",
    ),
    "verify": Command(
        "check whether everything is as committed, and if not, show what differs",
        (
            "--against",
            {
                "metavar": "PLACE",
                "help": "compare file by file with an archive, or with a folder that holds an "
                "unpacked archive or another tree",
            },
        ),
        _switch("--strict", "exit with status 1 for notes too"),
        _switch("--committed", "compare committed files alone: nothing has to be computed here"),
        details=" The layers are config, source, environment, data, drawing and file. The exit "
        "status is 1 for other bytes, for results that this tree did not make, and for figures of "
        "the paper that were not computed here; other differences are notes.",
    ),
    "accept": Command(
        "make the present figures the committed ones",
        details=" Includes other published pictures that were made, and prints what changed.",
    ),
    "clean": Command(
        "delete generated results; committed files stay",
        _names("folder", "variants, or other folders of results/; without a name, all"),
        _switch("--yes", "do not ask"),
    ),
    "benchmark": Command(
        "measure speeds and print a table of their ratios",
        module="program",
        details=" Installs the packages of the study first (once).",
    ),
    "test": Command(
        "run the test suite (arguments go to pytest)",
        module="program",
        details=" Installs the packages of the tests first (once).",
    ),
    "help": Command(
        "show this list, or the arguments of a COMMAND", _name("word", "a command", "COMMAND")
    ),
}
DEFAULT_COMMAND = SnakemakeCommand(
    "Draw the paper's figures from config.yaml into paper_figures/, unless they are current.",
    _names("figure", _FIGURES + "; also files, such as results/paper/orbits_fig2.nc"),
    _switch("--version", "print the versions of this project and of snakemake"),
)
# Command and option that an earlier version had -> what to do instead.
_REMOVED = {
    ("archive", "--machine"): "archive on such a machine",
    ("claims", "--check"): "all claims are judged",
    ("claims", "--data"): "the data of this tree are judged",
}
_OFFLINE = "./reproduce --offline DIR ... installs packages from a folder, without a network."
_SNAKEMAKE = "What follows -- goes to snakemake as it is: ./reproduce fig3 -- --dag"


class Arguments(argparse.Namespace):
    """A parsed command line: the names and flags of its `word`, None for the default command.

    `options` are the arguments for snakemake or pytest.
    """

    dry_run = False
    cores = "all"

    @property
    def makes_nothing(self) -> bool:
        """Whether -n was given, or an option with which snakemake prints something instead."""
        return self.dry_run or not _PRINTS.isdisjoint(self.options)

    @property
    def checked(self) -> dict[str, Any]:
        """The checked config.yaml."""
        if "config" not in self:
            from ..config import load  # needs packages

            self.config = load(ROOT / "config.yaml")
        return self.config


class _Parser(argparse.ArgumentParser):
    """A parser that reports a mistake in one line."""

    def error(self, message: str) -> NoReturn:
        message = explain(self, message)
        _refuse(message[0].lower() + message[1:], self.prog)


def read(arguments: list[str]) -> Arguments:
    """Parse a command line; raises SystemExit after help and after a mistake."""
    first, *rest = arguments or [""]
    word = first if first in COMMANDS else None
    if word == "test" and rest[:1] not in (["--help"], ["-h"]):
        return Arguments(word=word, options=rest)
    for option in (argument.partition("=")[0] for argument in rest):
        if word and (word, option) in _REMOVED:
            _refuse(f"{word}: {option} was removed: {_REMOVED[word, option]}")
    own, options = _split(COMMANDS.get(word or "", DEFAULT_COMMAND), rest if word else arguments)
    args = _parser(word).parse_args(own, Arguments())
    if word == "help":
        if args.word not in (None, *COMMANDS):
            _refuse(f"no command {args.word}{hint(args.word, COMMANDS)}")
        return read(["--help"] if args.word is None else [args.word, "--help"])
    if not word and args.version:
        print(_versions())
        sys.exit(0)
    args.word, args.options = word, options
    return args


def explain(parser: argparse.ArgumentParser, message: str) -> str:
    """Return a parser's message, with suggestions if it is about an unknown argument."""
    unknown = message.partition("unrecognized arguments: ")[2]
    if not unknown:
        return message
    first = unknown.split()[0]
    if first.partition("=")[0] == "--offline":
        return "--offline DIR comes first: ./reproduce --offline DIR ..."
    if first.startswith("-"):
        first = first.partition("=")[0]
    known = [name for action in parser._actions for name in action.option_strings]
    owners = [name for name, command in COMMANDS.items() if first in dict(command.arguments)]
    after = ": options of snakemake follow --" if "--cores" in known and first[0] == "-" else ""
    after = f": {owners[0]} has it" if owners and first[0] == "-" else after
    return f"no argument {first}{hint(first, known) or after}"


def hint(name: str, known: Iterable[str]) -> str:
    """End of a message about an unknown name: the nearest known names, if there are any."""
    question = suggestion(name, known)
    return f": {question}" if question else ""


def _refuse(message: str, program: str = "./reproduce") -> NoReturn:
    print(f"{program.replace('./', '', 1)}: {message}", file=sys.stderr)
    sys.exit(USAGE_STATUS)


def _split(command: Command, arguments: list[str]) -> tuple[list[str], list[str]]:
    """Return a command's own flags and then its names, and the options for snakemake after --."""
    if not command.runs_snakemake:
        return arguments, []
    end = arguments.index("--") if "--" in arguments else len(arguments)
    valued = {name for name, how in command.arguments if name[0] == "-" and "action" not in how}
    valued |= {"-c", "--cores"}
    flags, names, rest = [], [], arguments[:end]  # type: list[str], list[str], list[str]
    while rest:
        size = 2 if rest[0] in valued else 1
        (flags if rest[0].startswith("-") else names).extend(rest[:size])
        del rest[:size]
    return flags + names, arguments[end + 1 :]


def _number_of_cores(text: str) -> str:
    """Return a number of cores or `all` as snakemake reads it."""
    if re.fullmatch("all|[1-9][0-9]{0,5}", text):
        return text
    raise argparse.ArgumentTypeError(f"{text!r} is not allowed: expected 1 or more, or all")


def _parser(name: str | None) -> _Parser:
    command = COMMANDS.get(name or "", DEFAULT_COMMAND)
    if name:
        line = f"{command.line[0].upper()}{command.line[1:]}.{command.details}"
        parser = _Parser(f"./reproduce {name}", description=line, allow_abbrev=False)
        parser.epilog = _SNAKEMAKE if command.runs_snakemake else None
    else:
        unchanged = argparse.RawDescriptionHelpFormatter
        parser = _Parser("./reproduce", formatter_class=unchanged, allow_abbrev=False)
        parser.description = command.line
        width = max(map(len, COMMANDS))
        lines = [f"  {word:{width}}  {COMMANDS[word].line}" for word in COMMANDS]
        details = "./reproduce COMMAND --help shows a command's arguments."
        parser.epilog = "\n".join(["commands:", *lines, "", details, _OFFLINE, _SNAKEMAKE])
    for key, how in command.arguments:
        parser.add_argument(key, **how)
    if command.runs_snakemake:
        text = "print what would be made, and make nothing"
        parser.add_argument("-n", "--dry-run", "--dryrun", action="store_true", help=text)
        text = "processor cores to use; by default all"
        parser.add_argument(
            "-c", "--cores", type=_number_of_cores, default="all", metavar="N", help=text
        )
    usage = parser.format_usage().partition(": ")[2].strip()
    for metavar in [how["metavar"] for key, how in command.arguments if key in REQUIRED]:
        usage = usage.replace(f"[{metavar}]", str(metavar))
    parser.usage = usage
    return parser


def _versions() -> str:
    def search(pattern: str, file: str) -> str:
        text = (ROOT / file).read_text(encoding="utf-8")
        return str(re.findall(pattern, text, re.MULTILINE)[0])

    ours = search(r'^version = "(.+)"', "pyproject.toml")
    snakemake = search("^snakemake==([^ ;]+)", "requirements/lock.txt")
    return f"pseudorigid {ours}, snakemake {snakemake}"
