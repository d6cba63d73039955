"""./reproduce article: set the replication article from the results."""

from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import one_line
from pipeline.cli.lock import locked
from pipeline.cli.packages import add_packages
from pipeline.cli.running import interruptible
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT

from .. import archive

ARTICLE = "results/article.pdf"


def run(args: Arguments) -> int:
    """Set the article; results must be current, and figures the committed ones."""
    with locked(), interruptible(), one_line("article: "):
        left_out = archive.refuse_unpublished(ROOT, args.config)  # before the download
        print(*left_out, sep="\n", end="\n" * bool(left_out))
    add_packages("algebra", "article")  # it tells of claims and theorems
    from ..article import numbers, typesetting

    with locked(), interruptible(), one_line("article: "):
        pdf = typesetting.typeset(ROOT, numbers.numbers_of(ROOT, args.config))
        write_whole(ROOT / ARTICLE, pdf)
    print(f"{ARTICLE}  {len(pdf) / 1e6:.1f} MB")
    for words in numbers.missing(numbers.read_citation()):
        print(f"to be filled in in {numbers.CITATION}: {words}")
    return 0
