"""The report: one HTML page with the figures, their numbers and what made them."""
