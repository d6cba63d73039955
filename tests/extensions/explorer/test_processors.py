"""The kernel, compiled for other processors, gives the bits of this one's, under emulation."""

import re
import shutil
import subprocess

import numpy as np
import pytest

from extensions.explorer.compiled import entry_points
from extensions.processors.build import compiled
from helpers.parts.doubles import bits
from helpers.sections import sea
from pseudorigid import Ball, orbit
from study import states

BALL, ENERGY = states.BALL, states.ENERGY
IMPACTS, FOLLOWED, TOGETHER, ANGLES = 200_000, 2_000, 300, 200_000
# Calls the entry points as the page does. Numba passes the places of a result and an exception.
PROGRAM = """
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#define CALL(name, ...) if (name(result, &exception, __VA_ARGS__)) return 1
typedef double *D;
static double result[4];
static void *exception;
int history(D, void *, double, double, double, double, double, int, D);
int follow(D, void *, D, double, double, int, D);
int history_in_lanes(D, void *, D, int64_t *, int, double, double, int);
int elementary(D, void *, double);
static D read_doubles(size_t n) {
    D values = malloc(8 * n);
    return fread(values, 8, n, stdin) == n ? values : NULL;
}
int main(void) {
    D state = read_doubles(3), rows = malloc(8 * 4 * IMPACTS), orbit = read_doubles(24);
    CALL(history, state[0], state[1], state[2], 0.2, 0.04, IMPACTS, rows);
    fwrite(rows, 8, 4 * IMPACTS, stdout);
    CALL(follow, orbit, 0.2, 0.04, FOLLOWED, rows);
    fwrite(orbit, 8, 24, stdout);
    D lanes = read_doubles(30 * 264);
    int64_t order[264];
    CALL(history_in_lanes, lanes, order, 264, 0.2, 0.04, TOGETHER);
    fwrite(lanes, 8, 4 * 264, stdout);
    D angles = read_doubles(ANGLES);
    for (int i = 0; i < ANGLES; i++) {
        CALL(elementary, angles[i]);
        fwrite(result, 8, 3, stdout);
    }
    return 0;
}
"""


def followed(begin):
    """The 24 doubles of an orbit that this processor has followed, from those at its start."""
    orbit = [tuple(map(tuple, np.reshape(begin, (8, 3)).tolist()))]
    entry_points.follow(orbit, BALL.k, BALL.g, FOLLOWED, np.empty(5 * FOLLOWED))
    return np.ravel(orbit[0])


def angles():
    """Arguments that are the same on every machine, 1,000 of them beyond the largest angle."""
    rng = np.random.default_rng(20)
    exponents = rng.integers(1, 1023 + 20, ANGLES // 4) << 52
    tiny = (rng.integers(0, 2**52, ANGLES // 4) | exponents).view(float)
    ordinary = 200.0 * rng.random(ANGLES - ANGLES // 4 - 1000) - 100.0
    return np.concatenate([ordinary, tiny, 10.0 ** rng.uniform(7, 300, 1000)])


@pytest.mark.slow
@pytest.mark.parametrize("processor", ["aarch64", "riscv64"])
def test_another_processor_gives_the_same_bits(processor, tmp_path):
    compiler, emulator = f"{processor}-linux-gnu-gcc", f"qemu-{processor}"
    for tool in (compiler, emulator):
        if shutil.which(tool) is None:
            pytest.skip(f"no {tool} here")
    (tmp_path / "kernel.o").write_bytes(compiled(entry_points.__name__, processor))
    sizes = {"IMPACTS": IMPACTS, "FOLLOWED": FOLLOWED, "TOGETHER": TOGETHER, "ANGLES": ANGLES}
    source = re.sub(r"\b[A-Z]{6,}\b", lambda word: str(sizes.get(word[0], word[0])), PROGRAM)
    (tmp_path / "main.c").write_text(source)
    options = ["-static", "-O1", "-ffp-contract=off", "-o", "program", "main.c", "kernel.o"]
    subprocess.run([compiler, *options], cwd=tmp_path, check=True)
    start, many = BALL.start(states.CHAOTIC, ENERGY), np.array(sea(264))
    _, v, w = start
    begin = [*start, 0, BALL.k * w, -v, *np.eye(3).ravel(), 1, 1, 1, *np.zeros(6)]
    given = [*start, *begin, *many.ravel(), *np.zeros(27 * 264), *angles()]
    command = [emulator, tmp_path / "program"]
    result = subprocess.run(command, input=np.array(given).tobytes(), stdout=-1, check=True)
    theirs = np.split(np.frombuffer(result.stdout), np.cumsum([4 * IMPACTS, 24, 4 * 264]))
    ours = orbit(BALL, start, IMPACTS)
    expected = (
        np.array([ours[name].values for name in ("x", "xdot", "udot", "tau")]),
        followed(begin),
        Ball(BALL.k, BALL.g).after(many, TOGETHER),
        np.array([*map(entry_points.elementary, angles().tolist())]),
    )
    for mine, other in zip(expected, theirs, strict=True):
        assert np.array_equal(bits(mine.ravel()), bits(other))
