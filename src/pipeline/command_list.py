"""The commands of ./reproduce: those of the engine, and with them those of parts.

`reproduce` prints its help before anything is installed: only the standard library is used here.
"""

from functools import cache

from .declaration import Command, SnakemakeCommand, parts

# An argument that argparse treats as optional: without a name, the command itself lists the
# possible ones.
REQUIRED = "variant"
_FIGURES = "figures to draw, by their names in config.yaml; without a name, all"
COMMANDS = {
    "list": Command(
        "figures, charts and datasets that can be made, and their states",
        {
            "name": "figures, sets of figures or variants to list; without a name, all",
            "--json": "print a list of files with command, kind, variant, scene, path and state",
        },
        group="figures",
    ),
    "variant": SnakemakeCommand(
        "make the figures of variants, in results/VARIANT/figures/",
        {"variant": "variants or ranges of config.yaml; with names of figures, only these"},
        group="figures",
    ),
    "verify": Command(
        "check whether all is as committed, and if not, show what differs",
        {
            "--strict": "exit with status 1 for notes too",
            "--committed": "compare committed files alone: nothing has to be computed here",
            "--json": "print the findings about each published folder as JSON",
        },
        details="The layers are config, source, environment, data, drawing and file. The exit "
        "status is 1 for other bytes, for results that this tree did not make, and for figures of "
        "the paper that were not computed here; other differences are notes.",
        group="checks",
    ),
    "accept": Command(
        "make the present figures the committed ones",
        details="Includes other published pictures that were made, and prints what changed. "
        "Removes those that were published here, that no scene makes and git does not track.",
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
        {"word": {"nargs": "?", "metavar": "COMMAND", "help": "a command"}},
        group="figures",
    ),
}
GROUPS = ("figures", "checks", "parts", "publishing")  # of commands, as they are listed
DEFAULT_COMMAND = SnakemakeCommand(
    "Draw and publish the figures of config.yaml, unless they are current.",
    {
        "figure": _FIGURES + "; also files, such as results/paper/orbits_fig2.nc",
        "--version": "print the versions of this project and of snakemake",
    },
)


@cache
def all_commands() -> dict[str, Command]:
    """Return the commands of the engine and of parts, by their groups."""
    found = {**COMMANDS}
    for part in parts().values():
        found |= part.commands
    return {name: found[name] for group in GROUPS for name in found if found[name].group == group}
