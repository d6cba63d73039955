"""The words of ./reproduce: a module each, with `run(word, arguments, start)` -> exit status.

`start` is the folder in which the user stands; the current one is the project's.
"""
