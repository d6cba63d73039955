"""The written rules are those of the declared stages and kinds of picture."""

import ast
import re
import subprocess
import sys
from functools import cache
from types import SimpleNamespace

from project import ROOT
from snakemake.io import regex_from_filepattern, update_wildcard_constraints

from pipeline.config import load
from pipeline.config.build_specs import build_specs
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import STAGES
from pipeline.declaration import files

CORE = {file.stem: file for file in (ROOT / "workflow" / "rules").glob("*.smk")}
FILES = (*CORE.values(), *files("rules.smk"))
EACH = re.compile(r'^(?:use rule \w+ as )?(?:rule )?(\w+)(?: with)?:\n    """(.*)"""\n', re.M)
DATASET = re.compile(r'^        (\w+)=dataset\("(\w+)"\),$', re.M)


def rules(*files):
    """Return rule -> (its docstring, its other text)."""
    _, *found = EACH.split("\n".join(file.read_text() for file in files))
    return {found[i]: tuple(found[i + 1 : i + 3]) for i in range(0, len(found), 3)}


def stages(text):
    """Return the stages whose datasets a rule takes, each by its name."""
    found = DATASET.findall(text)
    assert all(name == stage for name, stage in found)
    return tuple(stage for _, stage in found)


ALL = rules(*FILES)


def test_each_stage_has_a_rule_with_its_inputs_its_result_and_its_function():
    for name, stage in STAGES.items():
        function, text = ALL[name]
        assert (function, stages(text)) == (stage.function, stage.inputs)
        paths = re.findall(rf'\("results/[^/]+/{name}(?:_{{scene}})?\.nc"\),$', text, re.M)
        joined = bool(stage.parts or stage.paper)
        assert len(paths) == 3 + joined and text.count("inputs_of(") == joined, name
        if stage.parts:
            assert ALL[f"{name}_block"][0] == stage.part


def test_nothing_runs_beside_a_measurement_of_seconds():
    assert "threads: lambda wildcards: workflow.cores" in ALL["work_all"][1]


def test_each_kind_of_picture_has_a_rule_with_its_stages():
    for name, kind in KINDS.items():
        if kind.model_fields["formats"].default:
            function, text = ALL[f"draw_{name}"]
            assert (function, stages(text)) == (kind.drawn_by, kind.stages)
            assert f'**of_kind("{name}"),' in text


def test_a_rule_has_the_scenes_of_its_kind_alone_where_sets_have_scenes_of_one_name():
    kinds = {"one": {"a": "jumps", "b": "portrait"}, "two": {"a": "portrait"}, "three": {}}
    scenes = {v: {s: SimpleNamespace(picture=k) for s, k in kinds[v].items()} for v in kinds}
    parsed, defined = ast.parse(CORE["common"].read_text()), {"VARIANTS": scenes, "cache": cache}
    parsed.body = [each for each in parsed.body if isinstance(each, ast.FunctionDef)]
    exec(compile(parsed, "common.smk", "exec"), defined)
    for output in ("figures/{scene}.{extension}", "provenance/{scene}.{extension}.json"):
        for kind in ("jumps", "portrait", "motion"):
            constraints = defined["of_kind"](kind) | {"scene": "a|b"}
            path = update_wildcard_constraints(f"results/{{variant}}/{output}", constraints, {})
            rule = re.compile(regex_from_filepattern(path))
            for variant, scene in [("one", "a"), ("one", "b"), ("two", "a"), ("two", "b")]:
                file = f"results/{variant}/{output.format(scene=scene, extension='png')}"
                assert bool(rule.match(file)) == (kinds[variant].get(scene) == kind)


def test_snakemake_takes_the_inputs_of_the_build_specifications():
    """Named inputs are looked up in the rules, and specifications in the config."""
    specs = build_specs(load(ROOT / "config.yaml"))
    wanted = [path for path in specs if not re.search(r"\.\d{4}\.nc$", path)]
    command = ["snakemake", "--cores", "1", "-n", "--forceall", *wanted]
    result = subprocess.run(
        [sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=True
    )
    jobs = re.split(r"^(?:local)?rule \w+:$", result.stdout, flags=re.M)[1:]
    found = [dict(re.findall(r"^    (input|output): (.*)$", job, re.M)) for job in jobs]
    taken = {re.split(" |,", job["output"])[0]: job.get("input", "") for job in found}
    for path in wanted:
        inputs = {file for file in taken[path].split(", ") if file and "/why/" not in file}
        assert inputs == set(specs[path].inputs), path
