"""What turns config.yaml into files, and says whether they are right."""

import pseudorigid

pseudorigid.load_from_text(__name__)
