"""One module for each kind of picture: the function `draw`, and what its axes hide."""
