"""Programs that run in processes of their own."""

import subprocess


def run(*command, **how):
    """Run a command; its output is text, and a failure is no error."""
    how = {"capture_output": True, "text": True} | how
    return subprocess.run([*map(str, command)], check=False, **how)
