"""Which of the project's files decide the bytes of a result, and what those files mean.

Records and manifests name these, so that editing a module makes again what uses it.
"""

import os
from pathlib import Path

from pseudorigid.kernel.compiled import import_closure as imports
from pseudorigid.kernel.compiled import syntax_hash as meanings

SRC = Path(__file__).resolve().parents[2]
ROOT = SRC.parent
# Every job loads these, and none reaches the bytes of a result: they write records and whole files,
# hash, load modules, and say why a job failed. Tests plant a change in each.
BOOKKEEPING = (
    "pipeline",
    "pipeline.jobs",
    "pipeline.jobs.dispatch",
    "pipeline.jobs.server",
    "pipeline.records",
    "pipeline.records.build_spec",
    "pipeline.records.files",
    "pipeline.records.record",
    "pipeline.records.sources",
    "pseudorigid",
    "pseudorigid.kernel.compiled.import_closure",
    "pseudorigid.kernel.compiled.syntax_hash",
)
# Module -> the files that it reads.
_READS = {
    "src/pseudorigid/proofs/theorems/statements.py": "src/pseudorigid/proofs/certificates/*.toml"
}


def source_files(*modules: str) -> list[str]:
    """The project's files behind some modules, without BOOKKEEPING.

    Parameters
    ----------
    *modules : str
        Dotted names, as for pseudorigid.kernel.compiled.import_closure.

    Returns
    -------
    list of str
        From the root.
    """
    found = imports.import_closure(SRC, *modules, leave_out=BOOKKEEPING)
    files = [os.path.relpath(file, ROOT) for file in found]
    for module in set(files) & set(_READS):
        files += sorted(os.path.relpath(file, ROOT) for file in ROOT.glob(_READS[module]))
    return files


def syntax_hash(path) -> str | None:
    """Hash of what a file means, None where there is none; see pseudorigid.kernel.compiled."""
    return meanings.syntax_hash(path)
