"""TOML files, read with an error that names file and reason."""

from __future__ import annotations

import os
import re
import tomllib
from pathlib import Path
from typing import Any

from .errors import BadInput


def read_toml(file: str | os.PathLike[str]) -> dict[str, Any]:
    """The document; raises BadInput with the file, and the line where the reader knows it."""
    try:
        return tomllib.loads(Path(file).read_text(encoding="utf-8-sig"))
    except OSError as wrong:
        raise BadInput(f"{file}: {wrong.strerror}") from wrong
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as wrong:
        raise BadInput(f"{file}: {wrong}") from wrong


def place_in(file: str | os.PathLike[str], table: str = "", number: int = 1, key: str = "") -> str:
    """"file:line" of a key in a table's body, of the table's header where the key does not stand there in plain writing, or the file
    alone. `table`: as in its header; "" the top of the document. `number`: which of the headers of an array, from 1."""
    header, here, seen, place = re.compile(r"\s*\[\[?\s*([^\]]*?)\s*\]"), "", 0, str(file)
    wanted = re.compile(rf"\s*(?:{re.escape(key)}|\"{re.escape(key)}\"|'{re.escape(key)}')\s*=") if key else None
    for line, text in enumerate(Path(file).read_text(encoding="utf-8-sig").splitlines(), 1):
        if begun := header.match(text):
            here = begun[1]
            seen += here == table
        inside = here == table and (not table or seen == number)
        if inside and begun:
            place = f"{file}:{line}"
        elif inside and wanted and wanted.match(text):
            return f"{file}:{line}"
    return place
