"""What can go wrong: the programs' own words as exceptions."""

from __future__ import annotations

import contextlib
import os
from typing import Iterator


class PhareError(Exception):
    """Phare could not do what was asked; the text is the program's own message."""


class BadInput(PhareError, ValueError):
    """A file, option or value that cannot be used (the programs' exit code 2): place and reason."""


class Failed(PhareError):
    """What was asked for was tried and did not come to its end (exit code 1, a signal, a time limit)."""


class NotFound(PhareError):
    """A program of Phare is not there, or not what it should be."""


class LawFailed(PhareError):
    """A control law raised, ended, or answered what cannot be followed; `__cause__` is what it raised."""


@contextlib.contextmanager
def told(place: str | os.PathLike[str]) -> Iterator[None]:
    """What the system says of a file or folder, as BadInput with its name."""
    try:
        yield
    except OSError as wrong:
        raise BadInput(f"{os.fspath(place)}: {wrong.strerror or wrong}") from wrong
