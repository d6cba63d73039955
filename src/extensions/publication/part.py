"""What publishing adds: archive, article, site, the comparison of variants, and Figure 1."""

from pipeline.command_list import COMMANDS
from pipeline.declaration import Command, Part, SceneSet, SnakemakeCommand, Stage

_COMMANDS, _TEXT = "extensions.publication.commands", ("claims", "explorer", "proofs")
_VERIFY = COMMANDS["verify"]
_AGAINST = {
    "metavar": "PLACE",
    "help": "compare file by file with an archive, or with a folder that holds an unpacked "
    "archive or another tree",
}
PART = Part(
    needs=("paper",),
    stages={"frames": Stage("extensions.publication.frames.scene_frames", "frames", ("orbits",))},
    sets={
        "publication": SceneSet(
            "more_figures/publication", "./reproduce fig1", "The model", key="publication"
        )
    },
    commands={
        "archive": Command(
            "write one tar of the figures, their data and provenance",
            {
                "file": {"nargs": "?", "help": "by default results/archive/pseudorigid.tar"},
                "--with-packages": "add the sources and the locked packages: runs offline",
                "--python": {
                    "metavar": "X.Y",
                    "help": "of these packages; by default the present one",
                },
            },
            module=f"{_COMMANDS}.archive",
            group="publishing",
            details="The same results give the same bytes. All results must be current.",
        ),
        "article": Command(
            "make the article, results/article.pdf",
            module=f"{_COMMANDS}.article",
            group="publishing",
            details="Installs the typesetter first (once).",
            needs=_TEXT,
        ),
        "compare": SnakemakeCommand(
            "show what differs between two variants or over a range, figure by figure",
            {
                "variant": "two variants (paper is one) or a range of config.yaml; with names of "
                "figures, only these",
            },
            module="extensions.publication.compare.command",
            group="checks",
        ),
        "site": SnakemakeCommand(
            "write results/site/: all pages, with explorer and article",
            {"--serve": "then serve it on this machine, with its search, until Ctrl-C"},
            module=f"{_COMMANDS}.site",
            group="publishing",
            details="Publishes committed files alone. Installs packages first (once).",
            needs=_TEXT,
        ),
        "verify": _VERIFY._replace(
            arguments={**_VERIFY.arguments, "--against": _AGAINST},
            module=f"{_COMMANDS}.against",
        ),
    },
    committed="extensions.publication.figures_page.committed",
    folders=("site", "archive", "compare"),
)
