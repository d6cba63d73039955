"""The commands of ./reproduce: each module has `run(args)`, which returns the exit status.

`args` is an `arguments.Arguments`; its `start` is the user's folder. The current folder is the
project's root.
"""
