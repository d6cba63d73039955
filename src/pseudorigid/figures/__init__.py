"""Drawing: one module for each kind of picture, one style, and one way to write a file.

`kinds.NAME.draw(scene, *datasets)` returns a matplotlib Figure; `canvas.render` turns it into the
bytes of a file. The pictures ignore the user's matplotlib settings and fonts, and use no arithmetic
whose bits depend on the machine. Importing this package imports none of its modules.
"""
