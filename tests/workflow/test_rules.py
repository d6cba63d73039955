"""The rules are those of the declared stages and kinds of picture, as Snakemake has them."""

import ast
import re
import subprocess
import sys
from functools import cache
from types import SimpleNamespace

import pytest
import yaml
from snakemake.io import regex_from_filepattern, update_wildcard_constraints

from helpers.project import ROOT
from pipeline.config import load
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.parts import STAGES
from pipeline.declaration import Stage, parts
from pipeline.records.provenance import spec_path

RULES = ROOT / "workflow" / "rules"


def snakemake(*arguments):
    """What snakemake prints."""
    command = [sys.executable, "-m", "snakemake", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


def test_each_stage_and_each_kind_has_a_rule_with_its_function():
    listed = dict(re.findall(r"^(\w+) \((.*)\)$", snakemake("--list"), re.M))
    expected = {name: stage.function for name, stage in STAGES.items()}
    expected |= {f"{name}_block": s.of_block for name, s in STAGES.items() if s.of_block}
    drawn = {name: kind for name, kind in KINDS.items() if kind.model_fields["formats"].default}
    assert listed == expected | {f"draw_{name}": kind.drawn_by for name, kind in drawn.items()}


def test_a_rule_has_the_scenes_of_its_kind_alone_where_sets_have_scenes_of_one_name():
    kinds = {"one": {"a": "jumps", "b": "portrait"}, "two": {"a": "portrait"}, "three": {}}
    scenes = {v: {s: SimpleNamespace(picture=k) for s, k in kinds[v].items()} for v in kinds}
    parsed = ast.parse((RULES / "common.smk").read_text())
    defined = {"VARIANTS": scenes, "cache": cache}
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


@pytest.fixture(scope="module")
def jobs():
    """Result -> rule, inputs, priority and threads of the job that makes it."""
    wanted = [*load(ROOT / "config.yaml").build_specs()]
    printed = snakemake("--cores", "3", "-n", "--forceall", *wanted)
    found = {}
    for job in re.split(r"^\[.*\]\n", printed, flags=re.M)[1:]:
        (rule,) = re.findall(r"^(?:local)?rule (\w+):$", job, re.M)
        fields = dict(re.findall(r"^    (\w+): (.*)$", job, re.M))
        if "output" in fields:
            result = re.split(" |,", fields["output"])[0]
            inputs = {*fields["input"].split(", ")} - {spec_path(result)}
            needs = dict(re.findall(r"(mem_mb|runtime)=(\d+)", fields["resources"]))
            priority, threads = int(fields.get("priority", 0)), fields.get("threads", "1")
            found[result] = rule, inputs, priority, threads, needs
    return found


def test_snakemake_takes_the_inputs_of_the_build_specifications(jobs):
    """Named inputs are looked up in the rules, and specifications in the config."""
    for path, spec in load(ROOT / "config.yaml").build_specs().items():
        assert jobs[path][1] == set(spec.inputs), path


def test_long_jobs_begin_first_and_nothing_runs_beside_a_measurement_of_seconds(jobs):
    for part in parts().values():
        for result, seconds in part.seconds.items():
            assert jobs[result][2] >= seconds, result
    alone = {name for name, stage in STAGES.items() if stage.alone}
    assert {rule for rule, _, _, threads, _ in jobs.values() if threads == "3"} == alone


def test_each_job_says_the_memory_and_the_time_that_its_stage_declares(jobs):
    for rule, *_, needs in jobs.values():
        stage = STAGES.get(rule.removesuffix("_block"), Stage(""))
        assert needs == {"mem_mb": str(stage.mem_mb), "runtime": str(stage.runtime)}, rule
    assert len({needs["runtime"] for *_, needs in jobs.values()}) > 1


def test_the_profile_of_the_cluster_says_nothing_about_single_jobs():
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    assert profile["executor"] == "slurm" and "default-resources" not in profile
