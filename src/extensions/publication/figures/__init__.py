"""The picture of the model."""
