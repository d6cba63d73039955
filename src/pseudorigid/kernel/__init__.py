"""One impact and many, compiled, with the same bits on every machine."""
