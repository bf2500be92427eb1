"""The command line, as ``bryla`` and as ``python -m bryla``."""

from __future__ import annotations

import sys


def main() -> int:
    """Runs the command line; returns its exit status."""
    from ._bryla import cli_main

    return cli_main(sys.argv)


if __name__ == "__main__":
    sys.exit(main())
