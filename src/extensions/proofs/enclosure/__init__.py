"""Enclosures that only proofs use, beside those in `study.enclosure`."""
