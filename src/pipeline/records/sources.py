"""Find the project's source files that decide the bytes of a result.

Records and manifests name these files, so that an edit of a module outdates the results that use
it.
"""

import os
from pathlib import Path

from ..declaration import extensions
from . import import_closure as imports
from . import syntax_hash as meanings

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
    """Paths, from the root, of the project's files that some modules import, directly or not.

    Modules are dotted names. BOOKKEEPING is left out; data files that modules read are included.
    """
    closure = imports.import_closure(SRC, *modules, leave_out=BOOKKEEPING)
    files = [os.path.relpath(file, ROOT) for file in closure]
    for extension in extensions().values():
        for module in extension.reads.keys() & {*files}:
            found = ROOT.glob(extension.reads[module])
            files += sorted(os.path.relpath(file, ROOT) for file in found)
    return files


def syntax_hash(path: str | os.PathLike[str]) -> str | None:
    """Hash of a source file's syntax, without comments and docstrings; None if there is no file."""
    return meanings.syntax_hash(path)
