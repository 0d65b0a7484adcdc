"""Writes TOML: what rigs, drives and plans need of it (tables, lists of tables, inline tables, words, numbers)."""

from __future__ import annotations

import json
import math
from typing import Any, Mapping

import numpy as np

from .errors import BadInput


def _value(value: Any) -> str:
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise BadInput(f"{value} has no place in a file")
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(each) for each in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(each)}" for key, each in value.items()) + " }"
    raise BadInput(f"{value!r} has no place in a TOML file")


def _key(key: str) -> str:
    return key if key and all(c.isascii() and (c.isalnum() or c in "-_") for c in key) else json.dumps(key)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(each, Mapping) for each in value)


def dumps(document: Mapping[str, Any], path: str = "") -> str:
    """The text of a document; keys that are None are left out."""
    lines, below = [], []
    for key, value in document.items():
        if value is None:
            continue
        name = f"{path}.{_key(key)}" if path else _key(key)
        if isinstance(value, Mapping):
            below.append(f"\n[{name}]\n{dumps(value, name)}")
        elif _is_tables(value):
            below += [f"\n[[{name}]]\n{dumps(each, name)}" for each in value]
        else:
            lines.append(f"{_key(key)} = {_value(value)}\n")
    return "".join(lines) + "".join(below)
