"""The workflow: it turns config.yaml into files and checks them."""

import sys

from .loading import Finder

if Finder not in sys.meta_path:
    sys.meta_path.insert(0, Finder)

from pseudorigid.kernel import compiled  # loaded from its text

from .records import sources

compiled.subfolder = sources.compiled_subfolder
