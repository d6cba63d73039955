"""The commands of ./reproduce: their arguments, their help, and refusals of mistakes.

`reproduce` prints its help before anything is installed: only the standard library is used here.
"""

import argparse
import re
import sys
from collections.abc import Iterable
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from ..command_list import DEFAULT_COMMAND, REQUIRED, all_commands
from ..declaration import files, lacking
from ..spelling import suggestion

if TYPE_CHECKING:  # it needs packages
    from ..config import Config

ROOT = Path(__file__).resolve().parents[3]
USAGE_STATUS = 2
# Options with which snakemake makes nothing.
_PRINTS = {
    *("-n", "--dry-run", "--dryrun", "--dag", "--rulegraph", "--filegraph", "--d3dag", "--lint"),
    *("-l", "--list", "--list-rules", "--lt", "--list-target-rules", "--lc", "--list-changes"),
    *("-S", "--summary", "-D", "--detailed-summary", "-t", "--touch", "--unlock"),
    *("-v", "--version", "-h", "--help"),
}


_OFFLINE = "./reproduce --offline DIR ... installs packages from a folder, offline."
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

    @cached_property
    def config(self) -> "Config":
        """The checked config.yaml."""
        from ..config import load  # needs packages

        return load(ROOT / "config.yaml")


class _Parser(argparse.ArgumentParser):
    """A parser that reports a mistake in one line."""

    def print_help(self, file: Any = None) -> None:
        """Print the help; argparse itself is silent if it cannot be written."""
        print(self.format_help(), end="", file=file)

    def error(self, message: str) -> NoReturn:
        message = explain(self, message)
        _refuse(message[0].lower() + message[1:], self.prog)


def read(arguments: list[str]) -> Arguments:
    """Parse a command line; raises SystemExit after help and after a mistake."""
    first, *rest = arguments or [""]
    if needed := lacking(first):
        _refuse(f"{first} needs the part {needed}, which is not in src")
    commands = all_commands()
    word = first if first in commands else None
    if word == "test" and rest[:1] not in (["--help"], ["-h"]):
        return Arguments(word=word, options=rest)
    if not word and first[:1] not in ("", "-") and not {"-h", "--help"}.isdisjoint(rest):
        given = [ROOT / "config.yaml", *files("scenes.yaml").values()]
        texts = [f.read_text(encoding="utf-8", errors="replace") for f in given if f.is_file()]
        names = re.findall(r"^ +([\w-]+):", "\n".join(texts), re.MULTILINE)  # help has no packages
        if not any(f"_{Path(first).stem}".endswith(f"_{name}") for name in names):
            _refuse(f"no command or figure {first}{hint(first, commands)}")
    own, options = rest if word else arguments, list[str]()
    if "--" in own and commands.get(word or "", DEFAULT_COMMAND).runs_snakemake:
        end = own.index("--")
        own, options = own[:end], own[end + 1 :]
    args = _parser(word).parse_intermixed_args(own, Arguments())
    if word == "help":
        if args.word not in (None, *commands):
            _refuse(f"no command {args.word}{hint(args.word, commands)}")
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
    owners = [name for name, command in all_commands().items() if first in command.arguments]
    after = ": options of snakemake follow --" if "--cores" in known and first[0] == "-" else ""
    after = f": {owners[0]} has it" if owners and first[0] == "-" else after
    return f"no argument {first}{hint(first, known) or after or f': usage: {parser.usage}'}"


def hint(name: str, known: Iterable[str]) -> str:
    """End of a message about an unknown name: the nearest known names, if there are any."""
    question = suggestion(name, known)
    return f": {question}" if question else ""


def _refuse(message: str, program: str = "./reproduce") -> NoReturn:
    """Print a line about a mistake, and end the process."""
    print(f"{program.replace('./', '', 1)}: {message}", file=sys.stderr)
    sys.exit(USAGE_STATUS)


def _number_of_cores(text: str) -> str:
    """Return a number of cores or `all` as snakemake reads it."""
    if re.fullmatch("all|[1-9][0-9]{0,5}", text):
        return text
    raise argparse.ArgumentTypeError(f"{text!r} is not allowed: expected 1 or more, or all")


def _parser(name: str | None) -> _Parser:
    """Return the parser of a command, or of the default command."""
    commands = all_commands()
    command = commands.get(name or "", DEFAULT_COMMAND)
    if name:
        line = f"{command.line[0].upper()}{command.line[1:]}. {command.details}"
        parser = _Parser(f"./reproduce {name}", description=line, allow_abbrev=False)
        parser.epilog = _SNAKEMAKE if command.runs_snakemake else None
    else:
        unchanged = argparse.RawDescriptionHelpFormatter
        parser = _Parser("./reproduce", formatter_class=unchanged, allow_abbrev=False)
        parser.description = command.line
        width = max(map(len, commands))
        lines = list[str]()
        for group, words in groupby(commands, lambda word: commands[word].group):
            lines += [
                f"{group}:",
                *(f"  {word:{width}}  {commands[word].line}" for word in words),
                "",
            ]
        details = "./reproduce COMMAND --help shows a command's arguments."
        parser.epilog = "\n".join([*lines, details, _OFFLINE, _SNAKEMAKE])
    for key, how in command.arguments.items():
        kind = {"action": "store_true"} if key.startswith("--") else {"nargs": "*"}
        parser.add_argument(key, **(kind | {"help": how} if isinstance(how, str) else how))
    if command.runs_snakemake:
        text = "print what would be made, and make nothing"
        parser.add_argument("-n", "--dry-run", "--dryrun", action="store_true", help=text)
        text = "processor cores to use; by default all"
        parser.add_argument(
            "-c", "--cores", type=_number_of_cores, default="all", metavar="N", help=text
        )
    parser.usage = parser.format_usage().partition(": ")[2].strip()
    for key, how in command.arguments.items():
        if key in REQUIRED:
            parser.usage = parser.usage.replace(f"[{how['metavar']}]", how["metavar"])
    return parser


def _versions() -> str:
    """Return the versions of this project and of snakemake."""

    def search(pattern: str, file: str) -> str:
        text = (ROOT / file).read_text(encoding="utf-8")
        return str(re.findall(pattern, text, re.MULTILINE)[0])

    ours = search(r'^version = "(.+)"', "pyproject.toml")
    snakemake = search("^snakemake==([^ ;]+)", "requirements/lock.txt")
    return f"pseudorigid {ours}, snakemake {snakemake}"
