"""The part of the report: one page on all results, and the comparison of two variants."""

from pipeline.declaration import Part, SnakemakeCommand, names

PART = Part(
    needs=("paper",),
    commands={
        "compare": SnakemakeCommand(
            "show what differs between two variants, figure by figure",
            ("a", {"nargs": "?", "help": "a variant of config.yaml, or paper", "metavar": "A"}),
            ("b", {"nargs": "?", "help": "another one", "metavar": "B"}),
            names(
                "figure", "figures to compare, by their names in config.yaml; without a name, all"
            ),
            module="extensions.report.compare.command",
        ),
        "report": SnakemakeCommand(
            "write one HTML page: figures, their numbers, corrections, run times",
            module="extensions.report.command",
        ),
    },
    folders=("report", "compare"),
)
