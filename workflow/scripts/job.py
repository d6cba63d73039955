"""What the scripts share: one line for a job that cannot be done, and the saving of a stage."""

import os
import sys
import traceback
from contextlib import contextmanager, suppress


def _uncaught(kind, error, trace):
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _uncaught  # Ctrl-C is no reason for a traceback


@contextmanager
def one_line_errors(snakemake):
    """Turn an error into one line on stderr and exit status 1; the job's log has its traceback."""
    log = snakemake.log[0]
    try:
        yield
    except Exception as error:
        message = " ".join(str(error).split())
        if not isinstance(error, ValueError):  # ValueErrors are written for the user
            message = f"{type(error).__name__}: {message} (traceback in {log})"
        message = f"pseudorigid: {_subject(snakemake.wildcards)}: {message}"
        with suppress(OSError), open(log, "w", encoding="utf-8") as file:  # or the disk is full
            file.write(f"{traceback.format_exc()}\n{message}\n")
        print(message, file=sys.stderr)
        sys.exit(1)


def _subject(wildcards):
    """What the job is about: a scene of the paper, a variant's scene, or a variant."""
    parts = [wildcards.get("variant", "paper"), wildcards.get("scene")]
    return "/".join(part for part in parts if part not in ("paper", None))


@contextmanager
def recorded(snakemake, config):
    """Write the record of what made the output, `config` being the block behind it."""
    from pseudorigid import provenance

    sources = [path for path in snakemake.input.code if path.endswith(".py")]
    inputs = set(snakemake.input) - set(snakemake.input.code)
    record = provenance.begin(config=config, inputs=inputs, sources=sources)
    yield
    provenance.finish(record, snakemake.output[0], snakemake.output.record)


def save_stage(snakemake, compute):
    """Save what `compute(ball, energy, **fields of the stage's block)` returns.

    A block with a `method` is computed by it, and its data say how many impacts that missed.
    """
    from pseudorigid import artifacts
    from pseudorigid.ball import Ball
    from pseudorigid.scan import ScannedBall

    block = snakemake.params.block
    os.environ["OMP_NUM_THREADS"] = str(snakemake.threads)
    with one_line_errors(snakemake), recorded(snakemake, block):
        taken = ("ball", "energy", "method")
        fields = {key: value for key, value in block.items() if key not in taken}
        ball, method = Ball(**block["ball"]), block.get("method")
        if method:
            ball = ScannedBall(ball.k, ball.g, method["scan"], method["tolerance"])
        dataset = compute(ball, block["energy"], **fields)
        if method:
            dataset.attrs |= {"impacts": ball.map.impacts, "impacts_missed": ball.map.missed}
        artifacts.save(
            dataset,
            snakemake.output[0],
            stage=snakemake.rule,
            ball=ball,
            energy=block["energy"],
            config=block,
        )
