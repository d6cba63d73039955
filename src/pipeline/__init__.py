"""The workflow: it turns config.yaml into files and checks them."""

from .loading import load_from_text

load_from_text()

from pseudorigid.kernel import compiled  # noqa: E402  (loaded from its text)

from .records import sources  # noqa: E402

compiled.subfolder = sources.compiled_subfolder
