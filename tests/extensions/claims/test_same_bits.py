"""Datasets of analyses and sweeps have the same bits again, and under another processor's rules."""

import os
import subprocess
import sys

import pytest
from project import ROOT

SMALL = """
from dataset_hash import content_hash
from pseudorigid import Ball
from extensions.claims.analyses import (
    clusters, control, exclusion, flux, jumps, rotation, spread,
)
from extensions.atlas import cell, last_curve
ball = Ball(0.2, 0.04)
for dataset in (
    spread.spread(ball, 0.01, 13, 2000, 4, [-0.44], 256, 8, 256),
    clusters.clusters(ball, 0.01, 16, 400, [4.0, 6.0], 2, 20, 1),
    control.control(ball, 0.01, [0.03], 20, 400, 6, [0.1], 0.03, 20, 20, 1),
    rotation.rotation(ball, 0.01, [0.026], 15, 600, (-0.8344, -0.8341), 600),
    jumps.jumps(ball, 0.01, [0.0018], 60),
    flux.flux(ball, 0.01, 6, 5e-3, 60, 16, 300),
    exclusion.exclusion(ball, 0.01, 20, 50),
    last_curve.last_curve(ball, 0.01, 3, (-0.2, -0.0325639), 300, 60, [[0, 5, 1, 15]]),
    cell.block_of_cells_of_a_sweep([[0.2, 6.25], [0.1, 0.3]], 20, 2000),
):
    print(content_hash(dataset))
"""


def hashes(**environment):
    process = subprocess.run(
        [sys.executable, "-c", SMALL],
        env=os.environ | {"PYTHONPATH": f"{ROOT}/src:{ROOT}/tests"} | environment,
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return process.stdout.split()


@pytest.mark.slow
def test_same_bits_on_another_machine(tmp_path):
    here = hashes()
    assert len(set(here)) == 9
    there = hashes(
        OMP_NUM_THREADS="1",
        NUMBA_CPU_NAME="generic",
        NUMBA_CACHE_DIR=str(tmp_path),
        NPY_DISABLE_CPU_FEATURES="X86_V3 X86_V4 AVX512_ICL",
        GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4",
        OPENBLAS_CORETYPE="Prescott",
        LC_ALL="C",
        TZ="Asia/Kathmandu",
        PYTHONHASHSEED="7",
    )
    assert here == there
