"""./reproduce verify: whether everything here is as committed."""

from ...checks.verify import summary, verify
from ...records.sources import ROOT
from ..arguments import Arguments
from ..table import WHAT_TO_DO, print_lines, wrapped


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    findings, lines = verify(ROOT, args.config, args.committed), list[str]()
    for each in findings:
        lines += [f"{each.published_set.folder}/", *each.report(), ""]
    failed = [line for each in findings for line in each.why(args.strict)]
    lines += [summary(findings), *failed]
    lines += [WHAT_TO_DO] if any(each.differences for each in findings) else []
    print_lines(part for line in lines for part in wrapped(line, 80) or [""])
    return int(bool(failed))
