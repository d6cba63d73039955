"""Compile entry points for another processor, with the compiler that numba uses.

Numba compiles for a generic processor, and LLVM optimises the same code for the other one. It
contracts and reorders no operation, so that results keep their bits.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from importlib.metadata import version
from itertools import count
from pathlib import Path
from typing import Any, NamedTuple

from pipeline.declaration import RENEW
from pipeline.records.files import file_hash, write_whole
from pipeline.records.sources import ROOT, source_files, syntax_hash

# Read by numba when it is imported. Only LLVM's later pass vectorises, for the other processor.
_SETTINGS = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
}


class Target(NamedTuple):
    """A processor as LLVM names it, and what is done to the code before and after it is compiled.

    `prepared` changes the text in LLVM's language of functions with some names, and returns it with
    the names that stay visible: in LLVM -> in the result. `emitted` returns the result.
    """

    triple: str
    processor: str = ""
    features: str = ""
    convention: str = ""  # of calls, where the common one does not do
    prepared: Callable[[str, dict[str, str]], tuple[str, dict[str, str]]] = lambda *same: same
    emitted: Callable[[Any, Any, list[str]], bytes] = lambda machine, module, _: (
        machine.emit_object(module)
    )


# Others are `TARGET` of the module of this package that has their name.
_TARGETS = {
    "aarch64": Target("aarch64-unknown-linux-gnu"),
    "riscv64": Target("riscv64-unknown-linux-gnu", "", "+m,+a,+f,+d,+c", "lp64d"),
}


class CompiledFile(NamedTuple):
    """A committed file of compiled entry points, with a record of what it was made from.

    ENTRY_POINTS of `module` maps each function to the types of its arguments, in numba's words.
    """

    path: Path
    module: str
    target: str

    @property
    def record_path(self) -> Path:
        """Where the record is."""
        return self.path.with_suffix(".json")

    def record(self) -> dict[str, Any]:
        """Return what decides the file: the meaning of its sources, and the versions."""
        files = source_files(self.module, f"{__package__}.{self.target}")
        return {
            "sources": {file: syntax_hash(ROOT / file) for file in sorted(files)},
            "environment": {name: version(name) for name in ("llvmlite", "numba")},
        }

    def is_current(self) -> bool:
        """Return whether the file is the recorded one, made from the kernel as it is."""
        with suppress(FileNotFoundError):
            made = json.loads(self.record_path.read_text(encoding="utf-8"))
            same = made["sha256"] == file_hash(self.path)
            return bool(same and made["sources"] == self.record()["sources"])
        return False

    def content(self) -> bytes:
        """Return the file; raises ValueError if it or the kernel was edited since."""
        if not self.is_current():
            file = self.path.relative_to(ROOT)
            raise ValueError(f"{file} is not what the kernel gives: run {RENEW}")
        return self.path.read_bytes()

    def renew(self) -> None:
        """Write the file and its record, if the file is not current."""
        if not self.is_current():
            code = compiled(self.module, self.target)
            self.path.write_bytes(code)
            made = self.record() | {"sha256": hashlib.sha256(code).hexdigest()}
            write_whole(self.record_path, json.dumps(made, indent=1) + "\n")


def compiled(module: str, target: str) -> bytes:
    """Return the code of a module's entry points for a target.

    It is compiled in a new process without kept machine code, because the settings are read when
    numba is imported, and kept code may have been compiled with others.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | _SETTINGS | {"NUMBA_CACHE_DIR": folder}
        command = [sys.executable, "-P", "-m", __name__, module, target]
        return subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True).stdout


def _code(module: str, name: str) -> bytes:
    """Compile in this process."""
    import llvmlite.binding as llvm
    import numba

    target: Target = _TARGETS.get(name) or import_module(f"{__package__}.{name}").TARGET
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    linked = llvm.parse_assembly("")
    names = {}
    for function, arguments in import_module(module).ENTRY_POINTS.items():
        point: Any = numba.njit(error_model="numpy")(getattr(function, "py_func", function))
        point.compile(arguments)
        ((signature, overload),) = point.overloads.items()
        names[overload.fndesc.llvm_func_name] = function.__name__
        linked.link_in(llvm.parse_assembly(point.inspect_llvm(signature)))
    text, names = target.prepared(_without_messages(str(linked)), names)
    code = llvm.parse_assembly(text)
    machine = llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=target.processor,
        features=target.features,
        opt=3,
        reloc="static",
        abiname=target.convention,
    )
    code.triple, code.data_layout = target.triple, str(machine.target_data)
    # All definitions but those with names are private, so that unused ones go.
    for value in (*code.functions, *code.global_variables):
        if value.name in names:
            value.name = names[value.name]
        elif not value.is_declaration:
            value.linkage = "internal"
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.slp_vectorization = True
    passes = llvm.create_pass_builder(machine, tuning)
    passes.getModulePassManager().run(code, passes)
    return target.emitted(machine, code, [*names.values()])


def _without_messages(text: str) -> str:
    """Empty and number the messages of exceptions, which nobody reads: they hold paths of files."""
    start = r"^(@\.const\.picklebuf\.\S+ = internal constant \{[^}]*\}) \{.*\}"
    text = re.sub(start, r"\1 zeroinitializer", text, flags=re.MULTILINE)
    numbers: dict[str, int] = {}
    counter = count()

    def numbered(name: re.Match[str]) -> str:
        return f"@message.{numbers.setdefault(name[0], next(counter))}"

    return re.sub(r"@\.const\.picklebuf\.[\w.$-]+", numbered, text)


if __name__ == "__main__":
    sys.stdout.buffer.write(_code(*sys.argv[1:]))
