"""Machine code: every operation is rounded once, in the order written, and no library is called."""

import math
import os
import re
import sys
from pathlib import Path

import numba
import numpy as np
import pytest

from helpers.matrix_probe import FUSED, traces
from helpers.programs import run
from helpers.sections import sea
from pseudorigid.kernel import arithmetic, impact, lanes, spectrum, tangents
from pseudorigid.kernel.compiled import folders, jit

# Flags with which the compiler may change the arithmetic.
LOOSE = re.compile(r"\bf(?:mul|add|sub|div) (?:fast|reassoc|contract)")


def compiled(function, *arguments):
    """Compile a kernel anew, because numba cannot show cached code."""
    fresh = numba.njit(error_model="numpy")(function.py_func)
    fresh(*arguments)
    return fresh


def test_machine_code_is_strict():
    assert impact.iterate.targetoptions["fastmath"] is False
    assert not impact.iterate.targetoptions.get("parallel")
    state = sea(2)
    for kernel, arguments in (
        (impact.iterate, (*state, 0.2, 0.04, 1, np.empty(2), np.empty((2, 1, 4)), None)),
        (lanes.iterate, (*state, 0.2, 0.04, 1, np.empty(2), np.empty((2, 1, 4)))),
        (impact.jacobians, (*state, 0.2, 0.04, 1, np.empty((2, 3, 3)), None)),
        (arithmetic.log, (2.0,)),
    ):
        fresh = compiled(kernel, *arguments)
        for signature, text in fresh.inspect_llvm().items():
            assert text.count("fmul double") > 10
            assert traces(fresh, signature) == [], kernel
            assert not LOOSE.search(text), kernel


@pytest.mark.slow
def test_loops_over_lanes_are_vectorised_and_strict():
    """The compiler vectorises a loop only if it can exclude negative indices."""
    row, n, h = np.ones(lanes.SIZE), lanes.LANES, (0.1, 0.1)
    states, flights = tangents.allocate_buffers()
    states[:] = flights[:] = 1.0
    frames = np.ones(15 * tangents.GROUP)
    for loop, arguments in (
        (lanes._begin_flights, (row, n, 0.2, 0.04, h)), (lanes._find_ends, (row, n, 0.04)),
        (lanes._march, (row, n, 0.04)), (lanes._choose, (row, n)),
        (tangents._derive, (states, flights, 0, 64, 0.2, 1.0, h)),
        (tangents._observe, (np.ones(tangents._ROWS), 64, 0.2, 1.0, h, states, flights, 0)),
        (spectrum._advance, (frames, 64, 0.2, 1.0, h, states, flights, 0)),
    ):  # fmt: skip
        fresh = compiled(loop, *arguments)
        ((signature, text),) = fresh.inspect_llvm().items()
        assert re.search(r"fdiv <\d+ x double>", text), loop
        assert traces(fresh, signature) == [] and not LOOSE.search(text), loop


def test_code_that_is_not_strict_is_noticed():
    @numba.njit(fastmath=True)
    def loose(a, b):
        return math.sin(a) * b + math.log(b)

    loose(1.0, 2.0)
    (signature,) = loose.signatures
    assert traces(loose, signature) and LOOSE.search(loose.inspect_llvm(signature))
    assert FUSED.findall("vfmadd213sd %xmm0, %xmm1, %xmm2")


def test_compilation_without_a_writable_folder(tmp_path):
    (tmp_path / "file").touch()
    program = "from pseudorigid.kernel.compiled import jit; print(jit(lambda x: x + 1)(1))"
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "file" / "cache")}
    result = run(sys.executable, "-c", program, env=environment)
    assert (result.stdout, result.stderr) == ("2\n", "")


def test_machine_code_is_kept_in_a_folder_of_the_functions_module():
    arithmetic.log(2.0)
    folder = Path(arithmetic.log.stats.cache_path)  # none if nothing is kept
    name = f"{arithmetic.__name__}-"
    assert folder.parent == Path(folders()[0]) and folder.name.startswith(name)
    assert [*folder.glob("*log*.nbi")]


def test_a_second_function_of_one_name_does_not_take_the_code_of_the_first():
    """As functions made in a loop: only the first one's code is kept."""

    def made(number):
        def function(x):
            return x + number

        function.__module__, function.__qualname__ = arithmetic.__name__, "made_in_a_test"
        return jit(function)

    first, second = made(1.0), made(2.0)
    assert (first(1.0), second(1.0)) == (2.0, 3.0)
    assert (first.stats.cache_path is None, second.stats.cache_path) == (False, None)
