"""What the explorer adds to the pipeline."""

from pipeline.declaration import Command, Part, switch

PART = Part(
    needs=("processors",),
    commands={
        "explore": Command(
            "write and open a page that computes orbits, with the same bits",
            switch("--no-open", "only write results/explorer.html"),
            module="extensions.explorer.command",
        ),
    },
    committed="extensions.explorer.page.committed",
)
