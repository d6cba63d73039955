"""./reproduce article: set the replication article from the results."""

from ...config.paths import ARTICLE
from ...publication import archive, citation
from ...records.files import write_whole
from ...records.sources import ROOT
from ..arguments import Arguments
from ..packages import add_packages
from ..session import interruptible, locked, one_line

NUMBERS = "results/article/numbers.json"


def run(args: Arguments) -> int:
    """Set the article; results must be current, and figures the committed ones."""
    with locked(), interruptible(), one_line("article: "):
        archive.refuse_unpublished(ROOT, args.checked)  # before the download
    add_packages("article")
    from ...publication.article import numbers, typesetting

    with locked(), interruptible(), one_line("article: "):
        write_whole(ROOT / NUMBERS, numbers.numbers_of(ROOT, args.checked))
        pdf = typesetting.typeset(ROOT, ROOT / NUMBERS)
        write_whole(ROOT / ARTICLE, pdf)
    print(f"{ARTICLE}  {len(pdf) / 1e6:.1f} MB")
    for words in citation.missing(citation.read()):
        print(f"to be filled in in {citation.CITATION}: {words}")
    return 0
