"""The written rules are those of the declared stages, kinds of picture and parts of the study."""

import re
import subprocess
import sys
from xml.etree import ElementTree

from project import ROOT

from pipeline.config import build_specs, load
from pipeline.config.schema import study as parts
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import STAGES

RULES = ROOT / "workflow" / "rules"
CORE = ("data", "figures", "study")
EACH = re.compile(r'^(?:use rule \w+ as )?(?:rule )?(\w+)(?: with)?:\n    """(.*)"""\n', re.M)
DATASET = re.compile(r'^        (\w+)=(?:dataset|of_figures)\("(\w+)"\),$', re.M)
CHART = re.compile(r'^        (\w+)="results/study/(\w+)\.nc",$', re.M)
CHARTS = re.compile(r'^        chart="(.*)",$', re.M)


def rules(names):
    """Return rule -> (its docstring, its other text)."""
    text = "\n".join((RULES / f"{name}.smk").read_text() for name in names)
    _, *found = EACH.split(text)
    return {found[i]: tuple(found[i + 1 : i + 3]) for i in range(0, len(found), 3)}


def stages(text):
    """Return the stages whose datasets a rule takes, each by its name."""
    found = DATASET.findall(text)
    assert all(name == stage for name, stage in found)
    return tuple(stage for _, stage in found)


ALL = rules(file.stem for file in RULES.glob("*.smk"))


def test_each_stage_has_a_rule_with_its_inputs_its_result_and_its_function():
    for name, stage in STAGES.items():
        function, text = ALL[name]
        assert (function, stages(text)) == (f"{stage.module}.{stage.function}", stage.inputs)
        assert text.count(f'("results/{{variant}}/{name}_{{scene}}.nc")') == 3, name


def test_each_kind_of_picture_has_a_rule_with_its_stages():
    for name, kind in KINDS.items():
        function, text = ALL[f"draw_{name}"]
        wanted = f"pseudorigid.figures.kinds.{name}.draw", kind.stages
        assert (function, stages(text)) == wanted
        assert f'scene=of_kind("{name}"),' in text


def test_each_part_and_each_chart_of_the_study_has_a_rule():
    study = rules(["study"])
    for part in (*parts.FIXED, *parts.MEASURED):
        _, text = study.pop(f"study_{part}")
        assert text.count(f'("results/study/{part}.nc")') == 3
        assert ("threads: lambda wildcards: workflow.cores" in text) == (part in parts.ALONE)
        assert stages(text) == (("periodic", "manifolds") if part == "needs" else ())
    drawn = {}
    for function, text in study.values():
        [(name, part)], [pattern] = CHART.findall(text), CHARTS.findall(text)
        assert name == part
        charts = [chart for chart in parts.CHARTS if re.fullmatch(pattern, chart)]
        drawn |= dict.fromkeys(charts, (part, function.removeprefix("pseudorigid.figures.study.")))
    assert drawn == {chart: (part, name) for chart, (part, name, _) in parts.CHARTS.items()}


def test_no_loop_makes_a_rule_of_the_core():
    for name in CORE:
        assert not re.search(r"^\s*(for|while) ", (RULES / f"{name}.smk").read_text(), re.M)


def chain():
    """Return the edges between the rules of data.smk and figures.smk."""
    written = rules(["data", "figures"]).items()
    return {(stage, name) for name, (_, text) in written for stage in stages(text)}


def test_the_chain_is_shown_by_the_comment_and_by_the_picture():
    comment = re.findall(r"^#     (\w+) -> (.*)$", (RULES / "data.smk").read_text(), re.M)
    assert {(stage, name) for stage, names in comment for name in names.split(", ")} == chain()
    svg = ElementTree.parse(ROOT / "docs" / "rulegraph.svg").getroot()
    groups = svg.iter("{http://www.w3.org/2000/svg}g")
    titles = {g[0].text: [t.text for t in g if t.tag.endswith("text")] for g in groups}
    names = {title: words[0] for title, words in titles.items() if words}
    edges = {tuple(names[n] for n in t.split("->")) for t in titles if "->" in t}
    assert {(a, b) for a, b in edges if b != "all"} == chain()
    assert {a for a, b in edges if b == "all"} == set(rules(["figures"]))


def test_snakemake_takes_the_inputs_of_the_build_specifications():
    """Named inputs are looked up in the rules, and specifications in the config."""
    specs = build_specs.of_all(load(ROOT / "config.yaml"))
    wanted = [path for path in specs if re.match(r"results/(?!sweep)", path)]
    command = ["snakemake", "--cores", "1", "-n", "--forceall", *wanted]
    result = subprocess.run(
        [sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=True
    )
    jobs = re.split(r"^rule \w+:$", result.stdout, flags=re.M)[1:]
    files = [dict(re.findall(r"^    (input|output): (.*)$", job, re.M)) for job in jobs]
    taken = {re.split(" |,", job["output"])[0]: job.get("input", "") for job in files}
    for path in wanted:
        inputs = {file for file in taken[path].split(", ") if file and "/why/" not in file}
        assert inputs == set(specs[path].inputs), path
