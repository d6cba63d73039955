"""What the explorer adds to the pipeline."""

from pipeline.declaration import Command, Part, switch

PART = Part(
    needs=("processors",),
    commands={
        "explore": Command(
            "open the interactive explorer in a browser",
            switch("--no-open", "only write results/explorer.html"),
            module="extensions.explorer.command",
        ),
    },
    committed="extensions.explorer.page.committed",
)
