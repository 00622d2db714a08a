"""``python -m generator`` is the command ``counterpoise``, also where it is not installed."""

import sys


def main() -> int:
    """Runs the command line; being interrupted is no defect, also while Python reads the program."""
    try:
        from generator.cli.main import main as command

        return command()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
