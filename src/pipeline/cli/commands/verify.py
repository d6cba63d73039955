"""./reproduce verify: whether everything here is as committed."""

import json
from typing import Any

from ...checks.verify import Findings, summary, verify
from ...records.sources import ROOT
from ..arguments import Arguments
from ..table import WHAT_TO_DO, print_lines, wrapped


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    findings, lines = verify(ROOT, args.config, args.committed), list[str]()
    for each in findings:
        lines += [f"{each.published_set.folder}/", *each.report(), ""]
    failed = [line for each in findings for line in each.why(args.strict)]
    if args.json:
        print(json.dumps([*map(_described, findings)], indent=1))
        return int(bool(failed))
    lines += [summary(findings), *failed]
    lines += [WHAT_TO_DO] if any(each.differences for each in findings) else []
    print_lines(part for line in lines for part in wrapped(line, 80) or [""])
    return int(bool(failed))


def _described(findings: Findings) -> dict[str, Any]:
    """Return findings by their names; a file has the layers in which it differs, or null if new."""
    files = {n: each and findings.differences.get(n, {}) for n, each in findings.layers.items()}
    lines = {name: getattr(findings, name) for name in ("failures", "notes", "unchecked")}
    return {"folder": findings.published_set.folder, "files": files, **lines}
