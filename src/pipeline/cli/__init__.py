"""The commands of ./reproduce. A standard stream that is closed is /dev/null to them."""

import os
import sys

# Otherwise the next file that is opened would be the stream. Each takes the lowest free number.
for _number, _name in enumerate(("stdin", "stdout", "stderr")):
    if getattr(sys, _name) is None:
        os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)
        setattr(sys, _name, os.fdopen(_number, "w" if _number else "r"))
