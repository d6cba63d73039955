"""PTX, the assembly language of NVIDIA's graphics processors: a kernel for each entry point.

The first argument of an entry point is a thread, which the kernel finds out itself: it takes the
number of threads instead. A kernel drops what numba returns, a status.
"""

import re
from typing import Any

from .build import Target

_KERNEL = """
define ptx_kernel void @{name}(i64 %threads{given}) {{
  %block = call i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
  %size = call i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
  %within = call i32 @llvm.nvvm.read.ptx.sreg.tid.x()
  %before = mul i32 %block, %size
  %sum = add i32 %before, %within
  %thread = zext i32 %sum to i64
  %inside = icmp ult i64 %thread, %threads
  br i1 %inside, label %run, label %end
run:
  %result = alloca i64
  %exception = alloca ptr
  %status = call i32 @{function}(ptr %result, ptr %exception, i64 %thread{given})
  br label %end
end:
  ret void
}}
"""
_DECLARED = """
declare double @llvm.sqrt.f64(double)
declare i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.tid.x()
"""


def _prepared(text: str, names: dict[str, str]) -> tuple[str, dict[str, str]]:
    """Add kernels, and replace the C library's square root, which a card does not have, by LLVM's.

    PTX has an instruction for it that rounds correctly.
    """
    import llvmlite.binding as llvm

    kernels, module = [_DECLARED], llvm.parse_assembly(text)
    for function, name in names.items():
        # After the places of the result and of an exception, and after the thread.
        types = [str(each.type) for each in module.get_function(function).arguments][3:]
        given = "".join(f", {kind} %a{i}" for i, kind in enumerate(types))
        kernels.append(_KERNEL.format(name=name, function=function, given=given))
    text = re.sub(r"^declare double @(llvm\.)?sqrt(\.f64)?\(.*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"@sqrt\b", "@llvm.sqrt.f64", text)
    return text + "\n".join(kernels), {name: name for name in names.values()}


def _emitted(machine: Any, module: Any, _: list[str]) -> bytes:
    text: str = machine.emit_assembly(module)
    return text.encode()


# Cards of compute capability 7.0 or higher run it.
TARGET = Target("nvptx64-nvidia-cuda", "sm_70", "+ptx70", prepared=_prepared, emitted=_emitted)
