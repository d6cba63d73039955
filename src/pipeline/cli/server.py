"""Jobs without a start of Python each: a server that has loaded what they need forks them.

Snakemake runs a `script:` in a new interpreter, which takes longer to load its packages than most
jobs to do their work. Each job is still a process of its own, and begins as that would.
"""

import multiprocessing
import os
import runpy
import subprocess
import sys
from contextlib import contextmanager, suppress
from importlib import import_module

# What snakemake sets for a job of one thread.
THREADS = ("OMP", "GOTO", "OPENBLAS", "MKL", "VECLIB", "NUMEXPR")
LOADED = (
    "snakemake.script",
    "pipeline.records.artifacts",
    "pipeline.records.drawings",
    "pipeline.records.record",
    "pseudorigid.dynamics.ensemble",
    "pseudorigid.figures.axes.box",
)


@contextmanager
def serving():
    """Have the scripts of snakemake's jobs run by a server while the body runs."""
    from snakemake.script import PythonScript

    jobs = multiprocessing.get_context("forkserver")
    usual = PythonScript.execute_script

    def execute_script(script, name, edit=False):
        elsewhere = script.conda_env or script.container_img or script.env_modules
        if edit or elsewhere or script.threads > 1 or script.shadow_dir:
            return usual(script, name, edit)
        job = jobs.Process(target=run, args=(name,))
        job.start()
        job.join()
        if job.exitcode:
            raise subprocess.CalledProcessError(job.exitcode, name)
        return None

    PythonScript.execute_script = execute_script
    try:
        yield
    finally:
        PythonScript.execute_script = usual


def begin() -> None:
    """Start the server, which loads while this process goes on."""
    from multiprocessing import forkserver

    names = [f"{name}_NUM_THREADS" for name in THREADS] + ["VECLIB_MAXIMUM_THREADS"]
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(names, "1"))
    try:
        multiprocessing.get_context("forkserver").set_forkserver_preload([f"{__name__}_loaded"])
        forkserver.ensure_running()
    finally:
        os.environ.clear()
        os.environ.update(before)


def load() -> None:
    """In the server: import what jobs do; what fails there is for a job to say."""
    for name in LOADED:
        with suppress(Exception):
            import_module(name)


def run(name) -> None:
    """In a job: run a script as a program."""
    try:
        runpy.run_path(name, run_name="__main__")
    except KeyboardInterrupt:
        sys.exit(130)
