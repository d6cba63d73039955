"""Which of the project's files decide the bytes of a result, and what those files mean.

Records and manifests name these, so that editing a module makes again what uses it.
"""

import os
from pathlib import Path

from pseudorigid.kernel.compiled import closure as imports
from pseudorigid.kernel.compiled import meaning as meanings

SRC = Path(__file__).resolve().parents[2]
ROOT = SRC.parent
# What snakemake reads: it says which function a job calls, with what.
WORKFLOW = ("Snakefile", "workflow/rules/common.smk", "workflow/rules/results.smk")
# Every job loads these, and none reaches the bytes of a result: they write records and whole files,
# hash, load modules, and say why a job failed. Tests plant a change in each.
BOOKKEEPING = (
    "pipeline",
    "pipeline.records",
    "pipeline.records.files",
    "pipeline.records.job",
    "pipeline.records.record",
    "pipeline.records.sources",
    "pseudorigid",
    "pseudorigid.kernel.compiled.closure",
    "pseudorigid.kernel.compiled.meaning",
)
# Module -> the files that it reads.
_READS = {
    "src/pseudorigid/proofs/theorems/statements.py": "src/pseudorigid/proofs/certificates/*.toml"
}


def code(script: str, *modules: str) -> list[str]:
    """The project's files that decide what a script of workflow/scripts makes.

    Parameters
    ----------
    script : str
        Its file's name.
    *modules : str
        Those that the script imports by a name it is given.

    Returns
    -------
    list of str
        From the root, the script and the workflow's own files included.
    """
    path = ROOT / "workflow" / "scripts" / script
    return [*WORKFLOW, os.path.relpath(path, ROOT), *closure(path, *modules)]


def closure(*starts: str | Path) -> list[str]:
    """The project's files behind some modules or scripts, without BOOKKEEPING.

    Parameters
    ----------
    *starts : str or pathlib.Path
        See pseudorigid.kernel.compiled.closure.

    Returns
    -------
    list of str
        From the root.
    """
    found = imports.closure(SRC, *starts, leave_out=BOOKKEEPING)
    files = [os.path.relpath(file, ROOT) for file in found]
    for module in set(files) & set(_READS):
        files += sorted(os.path.relpath(file, ROOT) for file in ROOT.glob(_READS[module]))
    return files


def meaning(path) -> str | None:
    """Hash of what a file means, None where there is none; see pseudorigid.kernel.compiled."""
    return meanings.meaning(path)
