"""The words of ./reproduce: a module each, with `run(given)` -> exit status.

`given` is an arguments.Given with `start`, the folder in which the user stands; the current one is
the project's.
"""
