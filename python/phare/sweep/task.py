"""One job's work, whoever does it: the drive, once more when it fails, and its row on the disk.

In the folder of a sweep: rows/NUMBER.json of each job that is done, jobs/NUMBER the drive. A drive is made beside and renamed, its row
is written last, under names of their own for each machine and process: killed at any moment, or done twice, a job leaves one whole row.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

from ..errors import PhareError
from .job import command_of, run_job
from .plan import Job, Plan, job_hash

_ATTEMPTS = 2


@dataclass(frozen=True)
class Kept:
    """A row as it lies on the disk."""

    row: dict[str, Any]
    told: list[str]  # what went wrong on the way, a line each

    @property
    def failed(self) -> bool:
        return bool(self.row.get("error"))


def drive_job(
    job: Job, plan: Plan, folder: Path, *, tell: Callable[[str], None] = lambda line: None, stopped: Callable[[], bool] = lambda: False
) -> None:
    """Drives it and writes its row, with the error where both attempts failed; nothing when it was stopped before it began.

    tell: is told each failure at once; the row keeps the lines for those who only see the disk.
    """
    making, there = folder / "jobs" / f"{job.name()}.making-{_who()}", folder / "jobs" / job.name()
    hash_before, told, row = job_hash(job, plan), list[str](), dict[str, Any]()
    for attempt in range(1, _ATTEMPTS + 1):
        if stopped():
            break
        shutil.rmtree(making, ignore_errors=True)
        try:
            row = run_job(job, plan, making)
            shutil.rmtree(there, ignore_errors=True)
            making.rename(there)
            break
        except (PhareError, OSError) as wrong:
            told.append(f"job {job.number}: {wrong}" + ("; once more" if attempt < _ATTEMPTS else ""))
            tell(told[-1])
            row = failed_row(job, plan, str(wrong))
    shutil.rmtree(making, ignore_errors=True)
    if row:
        write_row(job, folder, hash_before, Kept(row, told))


def failed_row(job: Job, plan: Plan, why: str) -> dict[str, Any]:
    """Of a job that has no figures."""
    return {"job": job.number, **job.varied, "error": why, "command": command_of(job, plan)}


def write_row(job: Job, folder: Path, hash_now: str, kept: Kept) -> None:
    """Written beside and renamed."""
    beside = folder / "rows" / f"{job.name()}.json.{_who()}.part"
    beside.write_text(json.dumps({"hash": hash_now, "row": kept.row, "told": kept.told}))
    beside.replace(folder / "rows" / f"{job.name()}.json")


def read_row(job: Job, folder: Path, hash_now: str) -> Kept | None:
    """None: there is none, or of other settings or files."""
    try:
        kept = json.loads((folder / "rows" / f"{job.name()}.json").read_text())
    except (OSError, json.JSONDecodeError):
        return None
    if not isinstance(kept, dict) or kept.get("hash") != hash_now or not isinstance(kept.get("row"), dict):
        return None
    return Kept(kept["row"], list(kept.get("told", [])))


def remove_leftovers(folder: Path, done: list[Job] | None = None) -> None:
    """What unfinished drives left: of processes of this machine that are no more; of jobs that are `done`, of any machine."""
    for making in [*folder.glob("jobs/*.making-*"), *folder.glob("rows/*.part")]:
        name, _, who = making.name.removesuffix(".part").partition(".json." if making.suffix == ".part" else ".making-")
        host, _, pid = who.rpartition("-")
        dead = host == socket.gethostname() and (pid == str(os.getpid()) or not Path(f"/proc/{pid}").exists())
        if dead or any(job.name() == name for job in done or ()):
            shutil.rmtree(making, ignore_errors=True) if making.is_dir() else making.unlink(missing_ok=True)


def _who() -> str:
    return f"{socket.gethostname()}-{os.getpid()}"
