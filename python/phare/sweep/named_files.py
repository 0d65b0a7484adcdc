"""What a file says is in other files: the lamp that a rig names, the way of a road user, the module that a law imports.

Found by reading: texts of a TOML file that name a file beside it (as `phare rig new --portable` finds them), uris of a glTF scene and the
tables beside it, imports of Python code. "generated/…" and this package are the programs' own. Left out: what a law opens by itself,
and code that is installed.
"""

from __future__ import annotations

import ast
import glob
import hashlib
import importlib
import importlib.util
import json
import site
import sysconfig
from functools import lru_cache
from pathlib import Path
from typing import Any, Iterator
from urllib.parse import unquote

from ..errors import BadInput
from ..toml_in import read_toml

_PACKAGE = Path(__file__).resolve().parents[1]
_SCENES = (".gltf", ".glb")
_Stamp = tuple[int, int, int]


def digest_of(file: Path) -> str:
    """Of the bytes of a file and of all that it names, and what those name; "none" where it is no file."""
    return _together({str(one): one for one in _closure(file)})


def digest_of_module(name: str) -> str:
    """Of a module's code and of what it imports that is no installed package."""
    importlib.invalidate_caches()
    found: dict[str, Path] = {}
    todo = [name]
    while todo:
        module = todo.pop()
        if module in found or (file := _code_of(module)) is None:
            continue
        found[module] = file
        if (stamp := _stamp(file)) is not None:
            todo += _imports(str(file), stamp, module)
    return _together(found)


def _together(files: dict[str, Path]) -> str:
    stamps = {name: (file, _stamp(file)) for name, file in files.items()}
    lines = [f"{name} {_digest(str(file), stamp)}" for name, (file, stamp) in stamps.items() if stamp is not None]
    return hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest() if lines else "none"


def _closure(file: Path) -> list[Path]:
    found: list[Path] = []
    todo = [file]
    while todo:
        one = todo.pop()
        stamp = _stamp(one)
        if stamp is not None and one not in found:
            found.append(one)
            todo += [*_names(str(one), stamp), *_beside(one)]
    return found


def _beside(file: Path) -> list[Path]:
    """Of a scene, the tables of its lane, its friction, its lamps."""
    if file.suffix not in _SCENES:
        return []
    return [other for other in file.parent.glob(f"{glob.escape(file.stem)}_*") if other.suffix in (".csv", ".toml")]


def _stamp(file: Path) -> _Stamp | None:
    """Of its contents; None: no file."""
    try:
        of = file.stat()
        return (of.st_ino, of.st_size, of.st_mtime_ns) if file.is_file() else None
    except (OSError, ValueError):  # a text may be no name at all
        return None


# A plan of many jobs names few files: each is read once as long as its stamp stays.


@lru_cache(maxsize=4096)
def _digest(file: str, stamp: _Stamp) -> str:
    try:
        return hashlib.sha256(Path(file).read_bytes()).hexdigest()
    except OSError as wrong:
        raise BadInput(f"{file}: {wrong.strerror}") from wrong


@lru_cache(maxsize=4096)
def _names(file: str, stamp: _Stamp) -> list[Path]:
    here = Path(file)
    try:
        if here.suffix == ".toml":
            words = [word for word in _texts(read_toml(here)) if word and not word.startswith("generated/")]
            return [here.parent / word for word in words]
        if here.suffix not in _SCENES:
            return []
        root = json.loads(_gltf_text(here))
        uris = [str(each["uri"]) for kind in ("buffers", "images") for each in root.get(kind, []) if "uri" in each]
        return [here.parent / unquote(uri) for uri in uris if not uri.startswith("data:")]
    except (BadInput, OSError, ValueError, AttributeError, TypeError):
        return []  # the drive says what is wrong with it


def _gltf_text(file: Path) -> bytes:
    """The JSON; of a .glb its first chunk, behind twelve bytes of the file's head and eight of its own."""
    if file.suffix == ".gltf":
        return file.read_bytes()
    with file.open("rb") as whole:
        head = whole.read(20)
        return whole.read(int.from_bytes(head[12:16], "little"))


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    for each in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from _texts(each)


@lru_cache(maxsize=1)
def _installed() -> tuple[Path, ...]:
    folders = [sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    return tuple(Path(folder).resolve() for folder in [*folders, *site.getsitepackages(), site.getusersitepackages()] if folder)


def _code_of(module: str) -> Path | None:
    """The file of a module; None: it is installed, built in, of this package, or not there."""
    top = module.partition(".")[0]
    try:
        if not _is_own(importlib.util.find_spec(top)):
            return None  # without importing it
        spec = importlib.util.find_spec(module)
    except (Exception, SystemExit):  # its parents are run
        return None
    return Path(spec.origin).resolve() if spec is not None and spec.origin and _is_own(spec) else None


def _is_own(spec: Any) -> bool:
    places = [spec.origin] if spec and spec.origin else list(spec.submodule_search_locations or []) if spec else []
    return bool(places) and places[0] not in ("built-in", "frozen") and not any(
        Path(place).resolve().is_relative_to(folder) for place in places for folder in (_PACKAGE, *_installed())
    )


@lru_cache(maxsize=4096)
def _imports(file: str, stamp: _Stamp, module: str) -> list[str]:
    """Names of modules that its code imports; what is taken from one may be a module of it."""
    try:
        tree = ast.parse(Path(file).read_bytes())
    except (OSError, SyntaxError, ValueError):
        return []
    package = module if Path(file).name == "__init__.py" else module.rpartition(".")[0]
    names = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package
            for _ in range(node.level - 1):
                base = base.rpartition(".")[0]
            whole = ".".join(part for part in (base if node.level else "", node.module or "") if part)
            names += [whole, *(f"{whole}.{alias.name}" for alias in node.names)] if whole else [alias.name for alias in node.names]
    return names
