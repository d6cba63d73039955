"""Hash of a dataset's content."""

import hashlib

from pipeline.checks.manifest import describe_data
from pipeline.records.artifacts import canonical_json


def content_hash(dataset):
    """Hash of names, dims, dtypes, values and attributes, as the manifest describes them."""
    sizes = {str(name): size for name, size in dataset.sizes.items()}
    described = describe_data(dataset) | {"sizes": sizes}
    return hashlib.sha256(canonical_json(described).encode()).hexdigest()
