"""Find the project's source files that decide the bytes of a result.

Records and manifests name these files, so that an edit of a module outdates the results that use
it.
"""

import os
from pathlib import Path

from ..declaration import extensions
from .import_closure import import_closure
from .syntax_hash import syntax_hash

__all__ = ["ROOT", "SRC", "source_files", "syntax_hash"]

SRC = Path(__file__).resolve().parents[2]
ROOT = SRC.parent
# Modules that every job loads and that do not affect the bytes of a result: they write records and
# whole files, hash, load modules and report failures. Tests plant a change in each.
BOOKKEEPING = (
    "pipeline",
    "pipeline.declaration",
    "pipeline.jobs",
    "pipeline.jobs.job",
    "pipeline.jobs.server",
    "pipeline.loading",
    "pipeline.records",
    "pipeline.records.build_spec",
    "pipeline.records.files",
    "pipeline.records.import_closure",
    "pipeline.records.machine_code",
    "pipeline.records.record",
    "pipeline.records.sources",
    "pipeline.records.syntax_hash",
    "pseudorigid",
)


def source_files(*modules: str) -> list[str]:
    """Return the paths, from the root, of the files that some modules depend on.

    `modules` are dotted names. BOOKKEEPING is left out, and data files that modules read are added.
    """
    closure = import_closure(SRC, *modules, leave_out=BOOKKEEPING)
    files = [os.path.relpath(file, ROOT) for file in closure]
    for extension in extensions().values():
        for module in extension.reads.keys() & {*files}:
            found = ROOT.glob(extension.reads[module])
            files += sorted(os.path.relpath(file, ROOT) for file in found)
    return files
