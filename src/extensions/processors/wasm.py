"""WebAssembly: a module that exports the entry points, as browsers load it."""

from typing import Any

from .build import Target

# Numbers of the sections of a module.
_CUSTOM, _IMPORTS, _EXPORTS, _CODE, _DATA_COUNT = 0, 2, 7, 10, 12


def _emitted(machine: Any, module: Any, names: list[str]) -> bytes:
    """Return a module with these functions."""
    code: bytes = machine.emit_object(module)
    functions = [each.name for each in module.functions if not each.is_declaration]
    return _with_exports(code, functions, names)


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


TARGET = Target("wasm32-unknown-unknown", "", "+simd128", emitted=_emitted)
