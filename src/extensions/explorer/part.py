"""What the explorer adds to the pipeline."""

from pipeline.declaration import Command, Part

PART = Part(
    needs=("processors",),
    commands={
        "explore": Command(
            "open the interactive explorer in a browser",
            {"--no-open": "only write results/explorer.html"},
            module="extensions.explorer.command",
        ),
    },
    committed="extensions.explorer.page.committed",
)
