"""Compile the entry points for another processor, with the compiler that numba uses.

    .venv/bin/python -m extensions.explorer.compiled.build

writes `kernel.wasm` and `kernel.json` beside this file: the module of the page, and what it was
made from. Numba compiles for a generic processor, and LLVM optimises the same code for the other
one. It contracts and reorders no operation, so that results keep their bits.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

from pipeline.declaration import RENEW
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT, source_files, syntax_hash

MODULE, RECORD = (Path(__file__).with_name(f"kernel.{end}") for end in ("wasm", "json"))
WASM = "wasm32-unknown-unknown"
# Triple -> features and calling convention, where the common ones do not do.
_PROCESSORS = {WASM: ("+simd128", ""), "riscv64-unknown-linux-gnu": ("+m,+a,+f,+d,+c", "lp64d")}
# Read by numba when it is imported. Only LLVM's later pass vectorises, for the other processor.
_SETTINGS = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
}
# Numbers of the sections of a WebAssembly module.
_CUSTOM, _IMPORTS, _EXPORTS, _CODE, _DATA_COUNT = 0, 2, 7, 10, 12


def record() -> dict[str, Any]:
    """Return what decides the module: the meaning of its sources, and the versions."""
    files = source_files(f"{__package__}.entry_points", f"{__package__}.build")
    return {
        "sources": {file: syntax_hash(ROOT / file) for file in sorted(files)},
        "environment": {name: version(name) for name in ("llvmlite", "numba")},
    }


def is_current() -> bool:
    """Return whether the module was made from the kernel as it is."""
    made = json.loads(RECORD.read_text(encoding="utf-8"))
    return bool(made["sources"] == record()["sources"])


def current_module() -> bytes:
    """Return the module; raises ValueError if the kernel was edited since it was made."""
    if not is_current():
        raise ValueError(f"the kernel was edited since the explorer's was compiled: run {RENEW}")
    return MODULE.read_bytes()


def compiled(triple: str) -> bytes:
    """Return the object code of the entry points for a processor; WebAssembly is a module.

    It is compiled in a new process without kept machine code, because the settings are read when
    numba is imported, and kept code may have been compiled with others.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | _SETTINGS | {"NUMBA_CACHE_DIR": folder}
        command = [sys.executable, "-P", "-m", f"{__package__}.build", triple]
        return subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True).stdout


def _object_code(triple: str) -> bytes:
    """Compile in this process."""
    import llvmlite.binding as llvm
    import numba

    from .entry_points import ENTRY_POINTS

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    linked = llvm.parse_assembly("")
    names = {}  # in LLVM -> in Python
    for function, arguments in ENTRY_POINTS.items():
        point: Any = numba.njit(error_model="numpy")(getattr(function, "py_func", function))
        point.compile(arguments)
        ((signature, overload),) = point.overloads.items()
        names[overload.fndesc.llvm_func_name] = function.__name__
        linked.link_in(llvm.parse_assembly(point.inspect_llvm(signature)))
    features, convention = _PROCESSORS.get(triple, ("", ""))
    target, options = llvm.Target.from_triple(triple), {"reloc": "static", "abiname": convention}
    machine = target.create_target_machine(opt=3, features=features, **options)
    # Messages of exceptions, which nobody reads, hold the paths of files.
    messages = r"^(@\.const\.picklebuf\.\S+ = internal constant \{[^}]*\}) \{.*\}"
    text = re.sub(messages, r"\1 zeroinitializer", str(linked), flags=re.MULTILINE)
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = triple, str(machine.target_data)
    # All definitions but the entry points are private, so that unused ones go.
    for value in (*module.functions, *module.global_variables):
        if value.name in names:
            value.name = names[value.name]
        elif not value.is_declaration:
            value.linkage = "internal"
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.slp_vectorization = True
    passes = llvm.create_pass_builder(machine, tuning)
    passes.getModulePassManager().run(module, passes)
    code: bytes = machine.emit_object(module)
    functions = [each.name for each in module.functions if not each.is_declaration]
    return _with_exports(code, functions, [*names.values()]) if triple == WASM else code


def _with_exports(code: bytes, functions: list[str], names: list[str]) -> bytes:
    """Return a WebAssembly object as a module that exports these of its functions, by their names.

    The object is a module already, whose calls and addresses are resolved because nothing else is
    linked. Its custom sections, with symbols and relocations, are left out.
    """
    sections, at = {}, 8  # after the magic number and the version
    while at < len(code):
        content = at + 1 + len(_number(0))
        size = sum((byte & 0x7F) << 7 * i for i, byte in enumerate(code[at + 1 : content]))
        sections[code[at]] = code[content : content + size]
        at = content + size
    del sections[_CUSTOM]
    # Functions would be counted after imported ones; the module imports only memory and its stack.
    if sections[_IMPORTS].count(b"\3env") != 2 or sections[_IMPORTS][0] != 2:
        raise RuntimeError("the kernel calls a function that the module does not have")
    exports = (_sized(name.encode()) + b"\0" + _number(functions.index(name)) for name in names)
    sections[_EXPORTS] = _number(len(names)) + b"".join(exports)
    order = sorted(sections, key=lambda kind: _CODE - 0.5 if kind == _DATA_COUNT else kind)
    return code[:8] + b"".join(bytes([kind]) + _sized(sections[kind]) for kind in order)


def _sized(content: bytes) -> bytes:
    """Return bytes after their number."""
    return _number(len(content)) + content


def _number(value: int) -> bytes:
    """Return a whole number in LEB128, in five bytes as LLVM writes the sizes of sections."""
    return bytes(value >> 7 * i & 0x7F | (0x80 if i < 4 else 0) for i in range(5))


def main(triple: str | None = None) -> None:
    """Write the module and its record, or with a triple, object code to standard output."""
    if triple:
        sys.stdout.buffer.write(_object_code(triple))
        return
    module = compiled(WASM)
    made = record() | {"sha256": hashlib.sha256(module).hexdigest()}
    MODULE.write_bytes(module)
    write_whole(RECORD, json.dumps(made, indent=1) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
