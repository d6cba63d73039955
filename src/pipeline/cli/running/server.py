"""Jobs without a start of Python each: a server that has loaded what they need forks them.

Snakemake runs a `script:` in a new interpreter, which takes longer to load its packages than most
jobs take for their work. A job from the server is a process of its own too, and ends as that would.
"""

import multiprocessing
import os
import runpy
import signal
import subprocess
from contextlib import contextmanager, suppress
from multiprocessing import forkserver

JOBS = multiprocessing.get_context("forkserver")
# What snakemake sets for a job of one thread.
THREADS = [f"{name}_NUM_THREADS" for name in ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")]
THREADS.append("VECLIB_MAXIMUM_THREADS")


def begin(computes: bool) -> bool:
    """Start the server, which loads while this process goes on; whether that can be done.

    Where nothing is computed, only drawn, it does without what takes longest to load.
    """
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(THREADS, "1"))
    # Inherited: Ctrl-C is for this process alone, which then ends the jobs.
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        modules = ["loaded", *(["compiled"] if computes else [])]
        JOBS.set_forkserver_preload([f"{__package__}.{name}" for name in modules])
        forkserver.ensure_running()
    except OSError:  # of a temporary folder whose name is too long for a socket
        return False
    finally:
        signal.signal(signal.SIGINT, handler)
        os.environ.clear()
        os.environ.update(before)
    return True


@contextmanager
def serving():
    """Have the scripts of snakemake's jobs of one thread run by the server."""
    from snakemake.script import PythonScript

    usual = PythonScript.execute_script

    def execute_script(script, name, edit=False):
        elsewhere = script.conda_env or script.container_img or script.env_modules
        if edit or elsewhere or script.shadow_dir or script.threads > 1:
            usual(script, name, edit)
            return
        # Not by its exit status: where other threads start jobs, multiprocessing may lose that.
        done, answer = JOBS.Pipe(duplex=False)
        job = JOBS.Process(target=run, args=(name, answer))
        job.start()
        answer.close()
        ended = None
        with done, suppress(EOFError):
            ended = done.recv()
        job.join()
        if isinstance(ended, str):
            raise ImportError(ended)
        if not ended:
            raise subprocess.CalledProcessError(job.exitcode or 1, name)

    PythonScript.execute_script = execute_script
    try:
        yield
    finally:
        PythonScript.execute_script = usual


def run(name, answer) -> None:
    """In a job: a script as a program of its own; it answers once that came to its end.

    It answers with words where the script ends before it can say itself why: it cannot be loaded.
    """
    said = True
    try:
        runpy.run_path(name, run_name="__main__")
    except (ImportError, SyntaxError) as error:
        said = str(error)
    with suppress(OSError):  # of a run that was killed
        answer.send(said)
