"""Runs the jobs of a plan and goes on where it stopped: on this machine, or by an engine.

In the folder of a sweep: rows and jobs (task.py), then table.csv (or .parquet) and index.html. Rows are read from the disk, whoever
drove: the table is the same.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Generator, TextIO

import pandas as pd

from ..errors import BadInput
from .engine import Engine, ThisMachine, Work
from .page import page_of
from .plan import Job, Plan, job_hash
from .task import Kept, failed_row, read_row, remove_leftovers, write_row


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
    plan: Plan, out: str | os.PathLike[str], *, workers: int | None = None, only: int | None = None, progress: TextIO | None = None,
    engine: Engine | None = None,
) -> Outcome:
    """Drives what has no row yet, then writes table and page.

    workers: drives at a time on this machine; None: one for each processor. only: this job alone. progress: where it is told, None:
    standard error. engine: who runs the jobs instead, Dask or Slurm. Raises BadInput, or Failed where an engine gives up.
    """
    jobs = [job for job in plan.jobs if only is None or job.number == only]
    if not jobs:
        raise BadInput(f"{plan.file}: has {len(plan.jobs)} jobs, no number {only}")
    folder = Path(out).absolute()
    for each in ("rows", "jobs"):
        (folder / each).mkdir(parents=True, exist_ok=True)
    with _alone_in(folder):
        return _run_jobs(plan, jobs, folder, engine or ThisMachine(workers), engine is not None, progress or sys.stderr)


@contextlib.contextmanager
def _alone_in(folder: Path) -> Generator[None, None, None]:
    """Two sweeps in one folder would clear away what the other is at; the lock goes with the process that holds it."""
    held = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as wrong:
            raise BadInput(f"{folder}: another sweep is at work there") from wrong
        yield
    finally:
        os.close(held)


def _run_jobs(plan: Plan, jobs: list[Job], folder: Path, engine: Engine, elsewhere: bool, progress: TextIO) -> Outcome:
    remove_leftovers(folder)
    hashes = {job.number: job_hash(job, plan) for job in jobs}
    kept = {job.number: read_row(job, folder, hashes[job.number]) for job in jobs}
    rows = {number: row.row for number, row in kept.items() if row and not row.failed}
    todo = [job for job in jobs if job.number not in rows]
    for job in todo:  # one that failed is driven again: its row must not be taken for the new one
        (folder / "rows" / f"{job.name()}.json").unlink(missing_ok=True)
    shown = Progress(len(jobs), progress)
    if rows:
        shown.tell(f"phare sweep: {len(rows)} of {len(jobs)} jobs have been driven before")
    work = Work(plan, todo, folder, lambda line: shown.tell(f"phare sweep: {line}"))
    with contextlib.closing(_ended(engine, work)) as ended:
        for job, why in ended:
            row = read_row(job, folder, hashes[job.number])
            if row is None:
                why = why or "ended without figures; were its files or the plan changed meanwhile?"
                row = Kept(failed_row(job, plan, why), [f"job {job.number}: {why}"])
                write_row(job, folder, hashes[job.number], row)
                work.tell(row.told[0])
            elif elsewhere:  # nobody here heard it
                for line in row.told:
                    work.tell(line)
            rows[job.number] = row.row
            shown.show(len(rows), len(rows) - len(jobs) + len(todo))
    remove_leftovers(folder, done=todo)
    table = pd.DataFrame([rows[job.number] for job in jobs])
    failed = [number for number, row in sorted(rows.items()) if row.get("error")]
    file = _write_table(table, folder)
    page = folder / "index.html"
    page.write_text(page_of(plan, table))
    return Outcome(table, file, page, failed, len(todo))


def _ended(engine: Engine, work: Work) -> Generator[tuple[Job, str], None, None]:
    if work.jobs:
        yield from engine.run(work)


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
