"""Run a command of ./reproduce with this machine in the place of a card."""

import sys

from host_card import HostCard

from extensions.atlas.gpu import card, run
from pipeline.cli.main import main

if __name__ == "__main__":
    run.Card, card.require_driver = lambda _: HostCard(), lambda: None
    sys.exit(main(sys.argv[1:]))
