"""Drawing: axes, one style, and one way to write a file.

`canvas.render` turns a matplotlib Figure into the bytes of a file. The pictures ignore the user's
matplotlib settings and fonts, and use no arithmetic whose bits depend on the machine. Importing
this package imports none of its modules.
"""
