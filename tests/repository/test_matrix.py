"""The bits are the same under the settings of other machines: a probe runs under them.

The probe computes tables, orbits, all stages and a figure of each kind; see matrix_probe.py.
"""

import json
import os
import sys
from pathlib import Path

import matrix_probe
import pytest
from fontTools.ttLib import TTFont
from matplotlib import get_data_path
from project import ROOT, run
from slowly import slowly

PROBE = ROOT / "tests" / "matrix_probe.py"
CONTROLS = {"library", "simd"}  # the probe's answers that the settings may change

# FOLDER is one of the probe's own, with a matplotlibrc and false fonts for ours.
OTHERS = {
    "MPLBACKEND": "svg", "SOURCE_DATE_EPOCH": "1", "MATPLOTLIBRC": "FOLDER/matplotlibrc",
    "HOME": "FOLDER", "XDG_DATA_HOME": "FOLDER",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4",
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
    "OPENBLAS_CORETYPE": "Prescott",
    "LANG": "C", "LC_ALL": "tr_TR.UTF-8", "TZ": "Pacific/Chatham", "PYTHONHASHSEED": "7",
    "OMP_NUM_THREADS": "3", "NUMBA_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "2",
}  # fmt: skip
OWN_CODE = {"NUMBA_CACHE_DIR": "FOLDER/code"}
ALL_BUT_COMPILER, ALL, HERE = "all but the compiler", "all at once", "compiled here"
# Name of a probe -> its mode and its settings. To find the setting at fault, leave others out.
PROBES = {
    ALL_BUT_COMPILER: ("everything", OTHERS),
    ALL: ("compiled", OTHERS | OWN_CODE | {"NUMBA_CPU_NAME": "generic"}),
    HERE: ("compiled", OWN_CODE),
    "not compiled": ("short", {"NUMBA_DISABLE_JIT": "1"}),
}
HOSTILE = """
axes.facecolor: red
figure.dpi: 37
savefig.dpi: 41
savefig.bbox: tight
savefig.facecolor: blue
savefig.transparent: True
font.family: monospace
font.size: 23
lines.antialiased: False
lines.linewidth: 7
lines.scale_dashes: False
mathtext.fontset: cm
path.simplify: True
svg.fonttype: none
svg.hashsalt: other
pdf.compression: 9
text.antialiased: False
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
    own = {"PYTHONPATH": str(ROOT / "src"), "MPLCONFIGDIR": str(folder / "config")}
    own |= {name: value.replace("FOLDER", str(folder)) for name, value in environment.items()}
    result = run(*python, PROBE, mode, env=kept | own, cwd=folder)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


@pytest.fixture
def answer(shared, pickled):
    """name -> the answer of that probe, run once for all tests; "as it is" in this process."""

    def ask(name):
        if name == "as it is":
            return pickled(name, lambda: dict(matrix_probe.everything()))

        def make(folder):
            found = probe(folder / name, *PROBES[name])
            (folder / "answer.json").write_text(json.dumps(found))

        return json.loads((shared(f"matrix {name}", make) / "answer.json").read_text())

    return ask


@pytest.mark.parametrize("settings", [ALL_BUT_COMPILER, *slowly(ALL, HERE)])
def test_the_same_bytes(answer, settings):
    expected, found = answer("as it is"), answer(settings)
    assert {name for name in expected if found[name] != expected[name]} <= CONTROLS


def test_plain_python_finds_the_compiled_bits(answer):
    assert answer("not compiled")["short"] == answer("as it is")["short"]


def test_control_the_c_library_honours_the_settings(answer):
    if answer(ALL_BUT_COMPILER)["library"] == answer("as it is")["library"]:
        pytest.skip("the C library's own sines do not change here: no FMA, or not glibc on x86-64")


def test_control_numpy_honours_the_settings(answer):
    if "X86_V3" not in answer("as it is")["simd"]:
        pytest.skip("this processor has none of the SIMD that the setting takes away")
    assert "X86_V3" not in answer(ALL_BUT_COMPILER)["simd"]


@pytest.mark.slow
@pytest.mark.parametrize("settings", [HERE, ALL])
def test_compiled_code_fuses_nothing_and_calls_no_library(answer, settings):
    as_it_is, found = answer("as it is"), answer(settings)
    assert found.pop("__main__.calls_the_library") == ["llvm.sin.f64"]
    fused = found.pop("__main__.may_fuse")
    if settings == HERE and "FMA3" in as_it_is["simd"]:
        assert any("fmadd" in name for name in fused)
    traces = {name: found[name] for name in found.keys() - as_it_is.keys()}
    assert len(traces) > 20
    assert {name: found for name, found in traces.items() if found} == {}
