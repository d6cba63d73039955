"""The workflow: it turns config.yaml into files and checks them."""

import pseudorigid

pseudorigid.load_from_text(__name__)
