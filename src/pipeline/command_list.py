"""The commands of ./reproduce: those of the engine, and with them those of parts.

`reproduce` prints its help before anything is installed: only the standard library is used here.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

from .declaration import Command, SnakemakeCommand, names, parts, switch


def _name(name: str, text: str, metavar: str | None = None) -> tuple[str, dict[str, Any]]:
    return name, {"nargs": "?", "help": text, "metavar": metavar or name.upper()}


# Required arguments that argparse treats as optional: without one, the command itself lists the
# possible names.
REQUIRED = ("variant", "a", "b")
_FIGURES = "figures to draw, by their names in config.yaml; without a name, all"
COMMANDS = {
    "list": Command(
        "figures, charts and datasets that can be made, and their states",
        names("name", "figures, sets of figures or variants to list; without a name, all"),
        group="figures",
    ),
    "variant": SnakemakeCommand(
        "make the figures of a variant, in results/NAME/figures/",
        _name("variant", "a variant of config.yaml", "NAME"),
        names("figure", _FIGURES),
        group="figures",
    ),
    "verify": Command(
        "check whether all is as committed, and if not, show what differs",
        switch("--strict", "exit with status 1 for notes too"),
        switch("--committed", "compare committed files alone: nothing has to be computed here"),
        details="The layers are config, source, environment, data, drawing and file. The exit "
        "status is 1 for other bytes, for results that this tree did not make, and for figures of "
        "the paper that were not computed here; other differences are notes.",
        group="checks",
    ),
    "accept": Command(
        "make the present figures the committed ones",
        details="Includes other published pictures that were made, and prints what changed.",
        group="publishing",
    ),
    "test": Command(
        "run the test suite (arguments go to pytest)",
        packages="test",
        details="Installs the packages of the tests first (once).",
        group="checks",
    ),
    "help": Command(
        "show this list, or the arguments of a COMMAND",
        _name("word", "a command", "COMMAND"),
        group="figures",
    ),
}
GROUPS = ("figures", "checks", "parts", "publishing")  # of commands, as they are listed
DEFAULT_COMMAND = SnakemakeCommand(
    "Draw and publish the figures of config.yaml, unless they are current.",
    names("figure", _FIGURES + "; also files, such as results/paper/orbits_fig2.nc"),
    switch("--version", "print the versions of this project and of snakemake"),
)


@cache
def all_commands() -> dict[str, Command]:
    """Return the commands of the engine and of parts, by their groups."""
    found = COMMANDS | {k: v for part in parts().values() for k, v in part.commands.items()}
    return dict(sorted(found.items(), key=lambda item: GROUPS.index(item[1].group)))


def options_of(command: str | None) -> list[tuple[str, dict[str, Any], str]]:
    """Return the options that parts add to a command of the engine."""
    return [p.options[command] for p in parts().values() if command and command in p.options]


def module_of(command: Command, name: str, given: Mapping[str, Any]) -> str:
    """Return the module that runs a command with these arguments."""
    for option, _, module in options_of(name):
        if given.get(option.strip("-").replace("-", "_")) is not None:
            return module
    module = command.module or name
    return module if "." in module else f"pipeline.cli.commands.{module}"
