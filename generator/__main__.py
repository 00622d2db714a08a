"""``python -m generator`` is the command ``counterpoise``, also where it is not installed."""

import sys

from generator.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
