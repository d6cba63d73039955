"""The same bits whatever the machine pretends to be: one probe under many settings.

The probe computes tables, orbits, all stages and a figure of each kind; see matrix_probe.py.
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from project import NO_CACHES, ROOT
from slowly import slowly

from pseudorigid.kernel import arithmetic

PROBE = ROOT / "tests" / "matrix_probe.py"
SWITCHES = {"library", "simd"}  # of the probe's answers those that the settings may change

GLIBC = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4"}
NUMPY = {"NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL"}
OPENBLAS = {"OPENBLAS_CORETYPE": "Prescott"}
GENERIC = {"NUMBA_CPU_NAME": "generic"}
ELSEWHERE = {"LANG": "C", "LC_ALL": "tr_TR.UTF-8", "TZ": "Pacific/Chatham", "PYTHONHASHSEED": "7"}
THREADS = {"OMP_NUM_THREADS": "3", "NUMBA_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "2"}
VARIANTS = {
    "numpy without SIMD": NUMPY,
    "glibc without FMA and AVX2": GLIBC,
    "another OpenBLAS kernel": OPENBLAS,
    "compiled for any x86-64": GENERIC,
    "another locale, time zone, hash seed and folder": ELSEWHERE,
    "other numbers of threads": THREADS,
    "a hostile matplotlibrc": {},
    "all but the compiler": NUMPY | GLIBC | OPENBLAS | ELSEWHERE | THREADS,
    "all at once": NUMPY | GLIBC | OPENBLAS | GENERIC | ELSEWHERE | THREADS,
}
HOSTILE = """
backend: pdf
figure.dpi: 37
savefig.dpi: 41
savefig.bbox: tight
savefig.transparent: True
font.family: monospace
font.size: 23
lines.antialiased: False
lines.linewidth: 7
mathtext.fontset: cm
path.simplify: True
svg.fonttype: none
svg.hashsalt: other
pdf.compression: 9
text.antialiased: False
"""


def probe(folder, mode, environment, src=ROOT / "src", python=(sys.executable,)):
    """The answer of the probe in a process and a folder of its own."""
    folder.mkdir(parents=True)
    (folder / "matplotlibrc").write_text(HOSTILE if "matplotlibrc" in folder.name else "")
    kept = {key: os.environ[key] for key in ("PATH", "HOME") if key in os.environ}
    command = [*python, str(PROBE), mode]
    result = subprocess.run(
        command,
        env=kept | {"PYTHONPATH": str(src), "MPLCONFIGDIR": str(folder)} | environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


@pytest.fixture
def answer(shared):
    """name -> the answer of that probe, run once for all tests."""

    def ask(name):
        def run(folder):
            mode, environment, src = {
                "compiled here": ("compiled", {"NUMBA_CACHE_DIR": str(folder)}, ROOT / "src"),
                "compiled for all": ("compiled", own_code(folder), ROOT / "src"),
                "plain": ("short", {"NUMBA_DISABLE_JIT": "1"}, ROOT / "src"),
                "as it is": ("everything", {}, ROOT / "src"),
            }.get(name) or (
                ("sincos", {}, edited(folder / "src", name))
                if name in edits()
                else ("everything", settings(name, folder), ROOT / "src")
            )
            found = probe(folder / name, mode, environment, src)
            (folder / "answer.json").write_text(json.dumps(found))

        return json.loads((shared(f"matrix {name}", run) / "answer.json").read_text())

    return ask


def own_code(folder):
    """Code compiled for any processor, apart from this one's."""
    return GENERIC | {"NUMBA_CACHE_DIR": str(folder / "code")}


def settings(name, folder):
    """The environment of a variant."""
    own = own_code(folder) if "NUMBA_CPU_NAME" in VARIANTS[name] else {}
    return VARIANTS[name] | own


def edited(src, name):
    """A copy of the source with one of the edits."""
    source, text = edits()[name]
    shutil.copytree(ROOT / "src", src, ignore=NO_CACHES)
    file = src / "pseudorigid" / "kernel" / "arithmetic.py"
    assert file.read_text().count(source) == 1
    file.write_text(file.read_text().replace(source, text))
    return src


def edits():
    """Name -> (a line of arithmetic.py, what takes its place)."""
    one = float.hex(math.nextafter(arithmetic._S1, 1.0))
    text = Path(arithmetic.__file__).read_text()
    constant = re.search(r'^_S1 = float\.fromhex\("(.*)"\)$', text, re.MULTILINE)
    sine = "    cosine, sine = quarter_turns(cosine, sine, n)\n    return"
    return {
        "a constant": (constant[0], f'_S1 = float.fromhex("{one}")'),
        "the library": (sine, "    sine, cosine = math.sin(t), math.cos(t)\n    return"),
    }


# Each costs as much as a run of everything, and where code is compiled anew three times as much.
QUICK = "all but the compiler"
SLOWLY = [QUICK, *slowly(*(name for name in VARIANTS if name != QUICK))]


@pytest.mark.parametrize("variant", SLOWLY)
def test_the_same_bytes(answer, variant):
    expected, found = answer("as it is"), answer(variant)
    assert set(found) == set(expected)
    assert [name for name in found if found[name] != expected[name] and name not in SWITCHES] == []


def test_plain_python_finds_the_compiled_bits(answer):
    assert answer("plain")["short"] == answer("as it is")["short"]


@pytest.mark.parametrize("edit", ["a constant", *slowly("the library")])
def test_a_change_of_sincos_shows(answer, edit):
    assert answer(edit)["table"] != answer("as it is")["table"]


def test_control_the_library_feels_the_switch(answer):
    if answer(QUICK)["library"] == answer("as it is")["library"]:
        pytest.skip("the C library's own sines do not change here: no FMA, or not glibc on x86-64")


def test_control_numpy_feels_the_switch(answer):
    before = answer("as it is")["simd"]
    if "X86_V3" not in before:
        pytest.skip("this processor has none of the SIMD that the switch takes away")
    assert "X86_V3" not in answer(QUICK)["simd"]


@pytest.mark.slow
@pytest.mark.parametrize("target", ["compiled here", "compiled for all"])
def test_compiled_code_fuses_nothing_and_calls_no_library(answer, target):
    found = answer(target)
    calls = found.pop("__main__.calls_the_library")
    assert calls == ["llvm.sin.f64"]
    fused = found.pop("__main__.may_fuse")
    if target == "compiled here" and "FMA3" in answer("as it is")["simd"]:
        assert any("fmadd" in name for name in fused)
    assert len(found) > 20
    assert {name: traces for name, traces in found.items() if traces} == {}
