"""The pictures: one module for each kind, one style, one door through which a picture is saved.

Each kind has `draw(scene, dataset, ...)`, which returns a matplotlib Figure; `canvas.render` makes
a file's bytes of it.

Nothing here looks at the user's matplotlib settings or fonts, keeps state between two pictures, or
uses arithmetic whose bits depend on the machine. Importing this package imports none of them.
"""
