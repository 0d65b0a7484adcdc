"""Runs the jobs of a plan on this machine: some at a time, each once more when it fails, and goes on where it stopped.

In the folder of a sweep: rows/NUMBER.json of each job that is done, jobs/NUMBER the drive, then table.csv (or .parquet) and
index.html. A job's drive is made beside and renamed, its row is written last: killed at any moment, the sweep goes on with what has no
row yet, and the table is the same.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import threading
import time
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

import pandas as pd

from ..errors import BadInput, PhareError
from .job import command_of, run_job
from .page import page_of
from .plan import Job, Plan, job_hash


@dataclass(frozen=True)
class Outcome:
    """What came of a sweep."""

    table: pd.DataFrame  # a row a job, in the plan's order
    file: Path  # where it lies
    page: Path
    failed: list[int]  # jobs without figures
    ran: int  # jobs that were driven now; the others had been


class Progress:
    """One line written over on a terminal, a line every tenth of the way elsewhere."""

    def __init__(self, whole: int, to: TextIO):
        self._whole, self._to, self._told, self._begin = max(whole, 1), to, 0, time.monotonic()

    def show(self, done: int, ran: int) -> None:
        share = done / self._whole
        left = (time.monotonic() - self._begin) / ran * (self._whole - done) if ran else 0.0
        text = f"phare sweep: {done} of {self._whole}, {share:4.0%}" + (f", some {left:.0f} s left" if ran else "")
        if self._to.isatty():
            bar = "#" * int(share * 30)
            self._to.write(f"\r{text:<52} [{bar:<30}]" + ("\n" if done == self._whole else ""))
        elif int(share * 10) > self._told or done == self._whole:
            self._told = int(share * 10)
            self._to.write(text + "\n")
        self._to.flush()

    def tell(self, line: str) -> None:
        """A line of its own."""
        self._to.write(("\n" if self._to.isatty() else "") + line + "\n")


def run_plan(
    plan: Plan, out: str | os.PathLike[str], *, workers: int | None = None, only: int | None = None, progress: TextIO | None = None
) -> Outcome:
    """Drives what has no row yet, then writes table and page.

    workers: drives at a time; None: one for each processor. only: this job alone. progress: where it is told, None: standard
    error. Raises BadInput when `out` holds a sweep of another plan's jobs that would be lost.
    """
    folder = Path(out).absolute()
    rows_folder, jobs_folder = folder / "rows", folder / "jobs"
    for each in (rows_folder, jobs_folder):
        each.mkdir(parents=True, exist_ok=True)
    _remove_leftovers(jobs_folder)
    jobs = [job for job in plan.jobs if only is None or job.number == only]
    if not jobs:
        raise BadInput(f"{plan.file}: has {len(plan.jobs)} jobs, no number {only}")
    hashes = {job.number: job_hash(job, plan) for job in jobs}
    rows = {job.number: row for job in jobs if (row := _kept_row(rows_folder, job, hashes[job.number])) is not None}
    todo = [job for job in jobs if job.number not in rows]
    shown = Progress(len(jobs), progress or sys.stderr)
    if rows:
        shown.tell(f"phare sweep: {len(rows)} of {len(jobs)} jobs have been driven before")
    stop = threading.Event()
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        waiting: set[Future[tuple[Job, dict[str, Any]]]] = {
            pool.submit(_one, job, plan, folder, hashes[job.number], shown, stop) for job in todo
        }
        try:
            while waiting:
                done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                for future in done:
                    job, row = future.result()
                    rows[job.number] = row
                shown.show(len(rows), len(rows) - len(jobs) + len(todo))
        except BaseException:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    table = pd.DataFrame([rows[job.number] for job in jobs])
    failed = [number for number, row in sorted(rows.items()) if row.get("error")]
    file = _write_table(table, folder)
    page = folder / "index.html"
    page.write_text(page_of(plan, table))
    return Outcome(table, file, page, failed, len(todo))


def _kept_row(folder: Path, job: Job, hash_now: str) -> dict[str, Any] | None:
    """Of a job that has been driven with the same settings and files; one that failed is driven again."""
    try:
        kept = json.loads((folder / f"{job.name()}.json").read_text())
    except (OSError, json.JSONDecodeError):
        return None
    if not isinstance(kept, dict) or kept.get("hash") != hash_now or kept.get("row", {}).get("error"):
        return None
    return dict(kept["row"])


def _remove_leftovers(jobs: Path) -> None:
    """Drives that were not finished: NUMBER.making-PID of a process that is no more."""
    for folder in jobs.glob("*.making-*"):
        pid = int(folder.name.rpartition("-")[2])
        if pid == os.getpid() or not Path(f"/proc/{pid}").exists():
            shutil.rmtree(folder, ignore_errors=True)


def _one(
    job: Job, plan: Plan, folder: Path, hash_now: str, shown: Progress, stop: threading.Event
) -> tuple[Job, dict[str, Any]]:
    """A job, once more when it fails; its row is on the disk when this returns."""
    making, there = folder / "jobs" / f"{job.name()}.making-{os.getpid()}", folder / "jobs" / job.name()
    row: dict[str, Any] = {}
    for attempt in (1, 2):
        if stop.is_set():
            break
        shutil.rmtree(making, ignore_errors=True)
        try:
            row = run_job(job, plan, making)
            shutil.rmtree(there, ignore_errors=True)
            making.rename(there)
            break
        except (PhareError, OSError) as wrong:
            again = "; once more" if attempt == 1 else ""
            shown.tell(f"phare sweep: job {job.number}: {wrong}{again}")
            row = {"job": job.number, **job.varied, "error": str(wrong), "command": command_of(job, plan)}
    shutil.rmtree(making, ignore_errors=True)
    beside = folder / "rows" / f"{job.name()}.json.part"
    beside.write_text(json.dumps({"hash": hash_now, "row": row}))
    beside.replace(folder / "rows" / f"{job.name()}.json")
    return job, row


def _write_table(table: pd.DataFrame, folder: Path) -> Path:
    """Parquet where pyarrow is installed, else CSV."""
    try:
        import pyarrow  # noqa: F401

        file = folder / "table.parquet"
        mixed = table.select_dtypes("object").columns
        table.astype({name: "string" for name in mixed}).to_parquet(file)
    except ImportError:
        file = folder / "table.csv"
        table.to_csv(file, index=False, float_format="%.12g")
    return file
