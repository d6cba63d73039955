"""./reproduce verify: whether everything here is as committed."""

from ...checks.verify import summary, verify
from ...records.sources import ROOT
from ..arguments import Arguments
from ..table import print_lines


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    findings = verify(ROOT, args.config, args.committed)
    for each in findings:
        print_lines([f"{each.published_set.folder}/", *each.report(), ""])
    print_lines([summary(findings)])
    return int(any(each.fails(args.strict) for each in findings))
