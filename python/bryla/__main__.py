"""The command line, as ``bryla`` and as ``python -m bryla``."""

from __future__ import annotations

import signal
import sys

from ._bryla import cli_main


def main() -> int:
    """Runs the command line; returns its exit code."""
    # no Python code runs meanwhile that could see a KeyboardInterrupt
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return cli_main(["bryla", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
