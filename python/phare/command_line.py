"""What the commands have in common: how they say what is wrong with their words, and how they end."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from typing import NoReturn

_SIGPIPE = 141
"""As a shell tells the end of who wrote into a pipe that nobody reads any more."""


class Parser(argparse.ArgumentParser):
    """Says in one line what is wrong, as the other programs do; exit code 2."""

    def error(self, message: str) -> NoReturn:
        print(f"{self.prog.removeprefix('python3 -m ')}: {message} (see --help)", file=sys.stderr)
        sys.exit(2)


def leave(main: Callable[[], int]) -> NoReturn:
    """Runs a command and ends with its exit code; silently where the reader of its output has left (`| head`), in one line and with 2 where
    what it printed could not be written."""
    code: int | str | None
    try:
        try:
            code = main()
        except SystemExit as end:  # --help, and words that are wrong
            code = end.code
        sys.stdout.flush()
    except OSError as wrong:
        if wrong.filename is not None:
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what Python flushes at its end goes there
        code = _SIGPIPE if isinstance(wrong, BrokenPipeError) else 2
        if code == 2:
            print(f"phare: standard output: cannot be written: {wrong.strerror}", file=sys.stderr)
    sys.exit(code)
