"""Compilation for other processors than this one, with the same bits."""
