"""./reproduce verify: whether everything here is as committed."""

from ...checks.verify import summary, verify
from ...records.sources import ROOT
from ..arguments import Arguments
from ..table import WHAT_TO_DO, print_lines, wrapped


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    findings = verify(ROOT, args.config, args.committed)
    for each in findings:
        print_lines([f"{each.published_set.folder}/", *each.report(), ""])
    failed = [each for each in findings if each.fails(args.strict)]
    print_lines([summary(findings), *(line for each in failed for line in each.why(args.strict))])
    if any(each.differences for each in failed):
        print_lines(wrapped(WHAT_TO_DO))
    return int(bool(failed))
