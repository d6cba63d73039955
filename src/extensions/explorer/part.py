"""What the explorer adds to the pipeline."""

from pipeline.declaration import Command, Part, switch

PART = Part(
    commands={
        "explore": Command(
            "write a page that computes orbits in a browser, with the same bits, and open it",
            switch("--no-open", "only write results/explorer.html"),
            module="extensions.explorer.command",
        ),
    },
    report="extensions.explorer.report",
    generated=("explorer.html",),
    committed="extensions.explorer.page.committed",
)
