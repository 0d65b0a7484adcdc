"""Finds the programs of Phare and runs them.

Where they are looked for, in this order: the folder that the environment variable PHARE_BIN names, PATH, the release
build of the checkout that this package lies in, and that of the folder one works in.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any, Iterable, Sequence

from .errors import BadInput, Failed, NotFound

_PROGRAMS = ("phare", "phare-cockpit", "phare-dynamics", "phare-visual")


def _checkouts() -> Iterable[Path]:
    for start in (Path(__file__).resolve().parent, Path.cwd()):
        for folder in (start, *start.parents):
            if (folder / "net" / "phare.proto").is_file() and (folder / "phare").is_file():
                yield folder
                break


def program(name: str = "phare") -> Path:
    """The file of a program (phare, phare-cockpit, phare-dynamics, phare-visual).

    Raises NotFound, which says where it was looked for.
    """
    folder = os.environ.get("PHARE_BIN")
    if folder:
        there = Path(folder) / name
        if os.access(there, os.X_OK):
            return there.resolve()
        raise NotFound(f"PHARE_BIN is {folder}, and there is no program {name} in it")
    on_path = shutil.which(name)
    if on_path and (Path(on_path).resolve().parent / "phare-visual").exists():
        return Path(on_path).resolve()  # the checkout's launcher of the same name has no programs beside it
    for checkout in _checkouts():
        there = checkout / "build" / "release" / "bin" / name
        if os.access(there, os.X_OK):
            return there
    raise NotFound(
        f"no program {name}: set PHARE_BIN to the folder of Phare's programs, put it on PATH, or build them (./phare drive)"
    )


def last_words(stderr: str, fallback: str) -> str:
    """The message of a program that ended badly: its last line, without its own name before it."""
    lines = [line.strip() for line in stderr.splitlines() if line.strip()]
    if not lines:
        return fallback
    said = [line for line in lines if line.startswith("phare")] or lines
    text = said[-1]
    head, _, rest = text.partition(": ")
    return rest if head in _PROGRAMS and rest else text


def raise_for(exit_code: int, stderr: str, what: str) -> None:
    """Turns the exit code of a program into an exception; 0 is fine."""
    if exit_code == 0:
        return
    if exit_code == 2:
        raise BadInput(last_words(stderr, f"{what}: bad input"))
    how = f"signal {-exit_code}" if exit_code < 0 else f"exit code {exit_code}"
    raise Failed(last_words(stderr, f"{what}: {how}"))


def run(
    arguments: Sequence[str | os.PathLike[str]],
    *,
    fine: tuple[int, ...] = (0,),
    timeout_s: float | None = None,
    cwd: str | os.PathLike[str] | None = None,
) -> subprocess.CompletedProcess[str]:
    """Runs `phare` with these arguments to its end and returns what it printed.

    fine: exit codes that are an answer and no error. timeout_s: seconds, None: as long as it takes.
    """
    command = [str(program()), *(os.fspath(argument) for argument in arguments)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s, cwd=cwd, check=False)
    except subprocess.TimeoutExpired as late:
        raise Failed(f"{' '.join(command[:3])}: not done after {timeout_s:g} s") from late
    if done.returncode not in fine:
        raise_for(done.returncode, done.stderr, " ".join(command[1:3]))
    return done


def run_json(arguments: Sequence[str | os.PathLike[str]], *, fine: tuple[int, ...] = (0,)) -> Any:
    """The same for a command with --json: its answer."""
    done = run([*arguments, "--json"], fine=fine)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError as wrong:
        raise Failed(f"{' '.join(str(a) for a in arguments[:2])} answered no JSON: {wrong}") from wrong


def version() -> str:
    """What `phare --version` says: version, commit, Vulkan device."""
    return run(["--version"]).stdout.strip()
