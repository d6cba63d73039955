"""The same bits whatever the machine pretends to be: one probe under many settings.

The probe computes tables, orbits, all stages and a figure of each kind; see matrix_probe.py.
"""

import ast
import json
import math
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from conftest import ROOT

from pipeline import config
from pipeline.records import sources
from pseudorigid.kernel import arithmetic

PROBE = Path(__file__).with_name("matrix_probe.py")
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


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """Every probe of this file, name -> future; as many run at once as there are cores."""
    folder = tmp_path_factory.mktemp("matrix")
    fresh = {"NUMBA_CACHE_DIR": str(folder / "fresh")}
    generic = {"NUMBA_CACHE_DIR": str(folder / "generic")} | GENERIC
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {
            # The two that compile come first, and the others find the code of the first.
            "compiled here": pool.submit(probe, folder / "1", "compiled", fresh),
            "compiled for all": pool.submit(probe, folder / "2", "compiled", generic),
            "plain": pool.submit(probe, folder / "3", "short", {"NUMBA_DISABLE_JIT": "1"}),
        }
        for name, (source, edited) in edits().items():
            copy = folder / name
            shutil.copytree(sources.PACKAGE, copy / "pseudorigid", ignore=NO_CACHES)
            file = copy / "pseudorigid" / "arithmetic.py"
            assert file.read_text().count(source) == 1
            file.write_text(file.read_text().replace(source, edited))
            jobs[name] = pool.submit(probe, folder / f"{name} out", "sincos", {}, copy)
        jobs["as it is"] = pool.submit(probe, folder / "as it is", "everything", {})
        for name, environment in VARIANTS.items():
            own = (
                {"NUMBA_CACHE_DIR": str(folder / "own" / name)}
                if "NUMBA_CPU_NAME" in environment
                else {}
            )
            jobs[name] = pool.submit(probe, folder / name, "everything", environment | own)
        yield jobs


NO_CACHES = shutil.ignore_patterns("__pycache__")


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


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_same_bytes(answers, variant):
    expected, found = answers["as it is"].result(), answers[variant].result()
    assert set(found) == set(expected)
    assert [name for name in found if found[name] != expected[name] and name not in SWITCHES] == []


def test_plain_python_finds_the_compiled_bits(answers):
    assert answers["plain"].result()["short"] == answers["as it is"].result()["short"]


@pytest.mark.parametrize("edit", ["a constant", "the library"])
def test_a_change_of_sincos_shows(answers, edit):
    assert answers[edit].result()["table"] != answers["as it is"].result()["table"]


@pytest.mark.parametrize("variant", ["glibc without FMA and AVX2", "all at once"])
def test_control_the_library_feels_the_switch(answers, variant):
    if answers[variant].result()["library"] == answers["as it is"].result()["library"]:
        pytest.skip("the C library's own sines do not change here: no FMA, or not glibc on x86-64")


def test_control_numpy_feels_the_switch(answers):
    before = answers["as it is"].result()["simd"]
    if "X86_V3" not in before:
        pytest.skip("this processor has none of the SIMD that the switch takes away")
    assert "X86_V3" not in answers["numpy without SIMD"].result()["simd"]


@pytest.mark.parametrize("target", ["compiled here", "compiled for all"])
def test_compiled_code_fuses_nothing_and_calls_no_library(answers, target):
    found = answers[target].result()
    calls = found.pop("__main__.calls_the_library")
    assert calls == ["llvm.sin.f64"]
    fused = found.pop("__main__.may_fuse")
    if target == "compiled here" and "FMA3" in answers["as it is"].result()["simd"]:
        assert any("fmadd" in name for name in fused)
    assert len(found) > 20
    assert {name: traces for name, traces in found.items() if traces} == {}


# ---- the source of what reaches a file ----

EXACT = {"sqrt", "floor", "ceil", "inf", "nan", "isnan", "isfinite", "copysign", "ulp", "nextafter"}
INEXACT = re.compile(
    r"(arc)?(sin|cos|tan)h?2?|a(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p|addexp2?)?|(float_)?power|"
    r"cbrt|hypot|dot|vdot|inner|outer|matmul|tensordot|einsum|kron|convolve|correlate|polyfit|sinc|"
    r"linalg|fft|deg2rad|rad2deg|angle|prange|vectorize|guvectorize"
)


def behind_the_figures():
    """Every file of the project whose bits can reach a figure."""
    files = {
        file for stages in config.STAGES.values() for s in stages for file in sources.stage_code(s)
    }
    files |= {file for picture in config.STAGES for file in sources.drawing_code(picture)}
    return sorted(files)


def inexact(tree):
    """Yield what has other bits on other machines, in a parsed module."""
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(value=ast.Name("math"), attr=name) if name not in EXACT:
                yield f"math.{name}"
            case ast.Attribute(value=ast.Name("np" | "numba" | "scipy"), attr=name):
                if INEXACT.fullmatch(name):
                    yield f"np.{name}"
            case ast.ImportFrom(module="math" | "numpy" | "scipy" | "cmath"):
                yield f"from {node.module}"
            case ast.Import(names=names):
                yield from (n.name for n in names if n.name.partition(".")[0] in ("scipy", "cmath"))
            case ast.BinOp(op=ast.MatMult()) | ast.AugAssign(op=ast.MatMult()):
                yield "@"
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                # Squares and powers of whole numbers are products; others go to pow.
                whole = ast.unparse(right).lstrip("-").isdecimal()
                if not (
                    ast.unparse(left).isdecimal()
                    or ast.unparse(right) == "2"
                    or (whole and ast.unparse(left) in ("2.0", "10.0"))
                ):
                    yield ast.unparse(node)
            case ast.keyword(arg="fastmath" | "parallel", value=value):
                if ast.unparse(value) != "False":
                    yield node.arg


@pytest.mark.parametrize("file", behind_the_figures())
def test_source_keeps_to_exact_arithmetic(file):
    assert list(inexact(ast.parse((ROOT / file).read_text()))) == []


def test_the_reading_of_the_source_finds_what_it_should():
    text = "np.dot(a, b); a @ b; math.sin(a); a ** 0.5; np.hypot(a, b); f(fastmath=True)"
    found = list(inexact(ast.parse(f"{text}; a**2; 2.0**-9; math.sqrt(a)")))
    assert sorted(found) == sorted(["np.dot", "@", "math.sin", "a ** 0.5", "np.hypot", "fastmath"])
