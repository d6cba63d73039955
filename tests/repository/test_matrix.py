"""The bits are the same under the settings of other machines: a probe runs under them.

The probe computes tables, orbits, stages and figures; see matrix_probe.py.
"""

import json
import os
import platform
import sys
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont
from matplotlib import get_data_path

from helpers import matrix_probe
from helpers.project import ROOT, run
from pipeline.declaration import parts

PROBE = ROOT / "tests/helpers/matrix_probe.py"
CONTROLS = {"library", "simd"}  # the probe's answers that the settings may change

# FOLDER is one of the probe's own, with a matplotlibrc and false fonts for ours. To find the
# setting at fault, leave others out.
OTHERS = {
    "MPLBACKEND": "svg", "SOURCE_DATE_EPOCH": "1", "MATPLOTLIBRC": "FOLDER/matplotlibrc",
    "HOME": "FOLDER", "XDG_DATA_HOME": "FOLDER",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4",
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
    "OPENBLAS_CORETYPE": "Prescott",
    "LANG": "C", "LC_ALL": "tr_TR.UTF-8", "TZ": "Pacific/Chatham", "PYTHONHASHSEED": "7",
    "OMP_NUM_THREADS": "3", "NUMBA_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "2",
}  # fmt: skip
HOSTILE = """
axes.facecolor: red
savefig.bbox: tight
font.family: monospace
font.size: 23
lines.antialiased: False
mathtext.fontset: cm
path.simplify: True
svg.hashsalt: other
pdf.compression: 9
text.hinting: none
text.usetex: True
"""


def probe(folder, mode, environment, python=(sys.executable,)):
    """The answer of the probe in a process and a folder of its own."""
    folder.mkdir(parents=True)
    if "MATPLOTLIBRC" in environment:
        (folder / "matplotlibrc").write_text(HOSTILE)
        (folder / ".fonts").mkdir()
        for family in ("DejaVu Sans", "STIXGeneral"):
            font = TTFont(Path(get_data_path()) / "fonts" / "ttf" / "cmss10.ttf")
            for record in font["name"].names:
                if record.nameID in (1, 16):
                    record.string = family
            font.save(folder / ".fonts" / f"{family}.ttf")
    kept = {key: os.environ[key] for key in ("PATH", "HOME") if key in os.environ}
    own = {
        "PYTHONPATH": f"{ROOT}/src{os.pathsep}{ROOT}/tests",
        "MPLCONFIGDIR": str(folder / "config"),
    }
    own |= {name: value.replace("FOLDER", str(folder)) for name, value in environment.items()}
    result = run(*python, PROBE, mode, env=kept | own, cwd=folder)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


@pytest.mark.slow
def test_the_same_bytes_under_other_settings(tmp_path):
    expected = dict(matrix_probe.everything())
    found = probe(tmp_path / "other", "everything", OTHERS)
    assert {name for name in expected if found[name] != expected[name]} <= CONTROLS
    if "X86_V3" in expected["simd"]:  # AVX2 and FMA: numpy and the C library honour the settings
        assert "X86_V3" not in found["simd"]
        assert found["library"] != expected["library"] or platform.libc_ver()[0] != "glibc"


@pytest.mark.slow
@pytest.mark.skipif(not {"claims", "atlas"} <= parts().keys(), reason="no analyses here")
def test_analyses_have_the_same_bits_on_another_processor(tmp_path):
    others = OTHERS | {"NUMBA_CPU_NAME": "generic", "NUMBA_CACHE_DIR": "FOLDER"}
    assert probe(tmp_path / "other", "analyses", others) == dict(matrix_probe.analyses())


def test_plain_python_finds_the_compiled_bits(tmp_path):
    found = probe(tmp_path / "not compiled", "short", {"NUMBA_DISABLE_JIT": "1"})
    assert found == dict(matrix_probe.short())
