"""The commands of ./reproduce: their arguments, their help, and refusals of mistakes.

`reproduce` prints its help before anything is installed: only the standard library is used here.
"""

import argparse
import re
import sys
from collections.abc import Collection, Iterable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import pseudorigid

from ..command_list import DEFAULT_COMMAND, REQUIRED, all_commands
from ..declaration import files, lacking
from ..records.files import read_text
from ..records.sources import ROOT
from ..spelling import suggestion

if TYPE_CHECKING:  # it needs packages
    from ..config import Config

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
    told: Collection[str] = ()  # the lines that the property `config` has printed

    @property
    def makes_nothing(self) -> bool:
        """Whether -n was given, or an option with which snakemake prints something instead."""
        return self.dry_run or not _PRINTS.isdisjoint(self.options)

    @cached_property
    def config(self) -> "Config":
        """The checked config.yaml. Prints mistakes in variants and a warning on balls, once."""
        from ..config import load  # needs packages

        config = load(ROOT / "config.yaml")
        lines = [line for mistakes in config.faulty.values() for line in mistakes]
        if names := ", ".join(config.faulty):
            lines.append(f"reproduce: left out because of these mistakes: {names}")
        lines += [f"reproduce: {words}"] if (words := config.warning()) else []
        for line in dict.fromkeys(each for each in lines if each not in self.told):
            print(line, file=sys.stderr)
        self.told = lines
        return config


class _Parser(argparse.ArgumentParser):
    """A parser that reports a mistake in one line."""

    def print_help(self, file: Any = None) -> None:
        """Print the help; argparse itself is silent if it cannot be written."""
        print(self.format_help(), end="", file=file)

    def error(self, message: str) -> NoReturn:
        """End the process with the message, or with what an unknown argument may mean."""
        if unknown := message.partition("unrecognized arguments: ")[2]:
            name, usage = unknown.split()[0], " ".join((self.usage or "").split())
            after = f": usage: {usage}"
            if name.startswith("-"):
                name = name.partition("=")[0]
                owners = [word for word, c in all_commands().items() if name in c.arguments]
                if "--cores" in self._option_string_actions:
                    after = ": options of snakemake follow --"
                after = f": {owners[0]} has it" if owners else after
            message = f"no argument {name}{hint(name, self._option_string_actions) or after}"
            if name == "--offline":
                message = "--offline DIR comes first: ./reproduce --offline DIR ..."
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
        return read([*filter(None, [args.word]), "--help"])
    if not word and args.version:
        lock = read_text(ROOT / "requirements/lock.txt")
        (snakemake,) = re.findall("^snakemake==([^ ;]+)", lock, re.MULTILINE)
        print(f"pseudorigid {pseudorigid.__version__}, snakemake {snakemake}")
        sys.exit(0)
    args.word, args.options = word, options
    return args


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
        width, lines, group = max(map(len, commands)), list[str](), ""
        for word, each in commands.items():
            if each.group != group:
                group = each.group
                lines += ["", f"{group}:"]
            lines.append(f"  {word:{width}}  {each.line}")
        details = "./reproduce COMMAND --help shows a command's arguments."
        parser.epilog = "\n".join([*lines[1:], "", details, _OFFLINE, _SNAKEMAKE])
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
    parser.usage = parser.usage.replace(f"[{REQUIRED} ...]", f"{REQUIRED} [{REQUIRED} ...]")
    return parser
