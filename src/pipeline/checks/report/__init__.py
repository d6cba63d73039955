"""The report: one HTML page with the figures, what was measured in them, and what made them."""
