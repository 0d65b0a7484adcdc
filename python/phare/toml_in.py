"""TOML files, read with an error that names file and reason."""

from __future__ import annotations

import os
import tomllib
from pathlib import Path
from typing import Any

from .errors import BadInput


def read_toml(file: str | os.PathLike[str]) -> dict[str, Any]:
    """The document; raises BadInput with the file, and the line where the reader knows it."""
    try:
        return tomllib.loads(Path(file).read_text(encoding="utf-8"))
    except OSError as wrong:
        raise BadInput(f"{file}: {wrong.strerror}") from wrong
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as wrong:
        raise BadInput(f"{file}: {wrong}") from wrong
