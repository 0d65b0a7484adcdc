"""Runs a sweep's jobs on workers of Dask: those of a scheduler, or of a cluster of its own on this machine.

A worker that is lost in the middle of a job has it driven by another; Dask gives a job up after its workers died four times. Workers
see the folder of the sweep, the plan's files and Phare's programs under the same names as here, and have this package.
"""

from __future__ import annotations

import asyncio
import collections
import concurrent.futures
import os
import time
from pathlib import Path
from typing import Any, Callable, Iterator

from ..errors import BadInput, Failed
from ..programs import program
from .engine import Engine, Work
from .plan import Job, Plan
from .task import drive_job

_TELL_AFTER_S = 10.0
_POLL_S = 0.1
_BACK_WITHIN_S = 15.0  # a client gives a connection up after about 10
_MOST_ASKED = 5  # of one job
_ANSWER_S = 30.0  # one bit, or the state of some jobs


def _on_worker(job: Job, plan: Plan, folder: str, programs: str) -> bool:
    """False where the folder of the sweep is not there."""
    os.environ.setdefault("PHARE_BIN", programs)
    if not (Path(folder) / "rows").is_dir():
        return False
    drive_job(job, plan, Path(folder))
    return True


class Dask(Engine):
    """address: of a scheduler, tcp://HOST:PORT; "local": a cluster on this machine with so many workers (None: one for each
    processor), which ends with the sweep."""

    def __init__(self, address: str, workers: int | None = None):
        try:
            import distributed
        except ImportError as wrong:
            raise BadInput("--dask: needs Dask's distributed: apt-get install python3-distributed, or pip install distributed") from wrong
        self._distributed: Any = distributed
        self._address, self._workers = address, workers

    def run(self, work: Work) -> Iterator[tuple[Job, str]]:
        d = self._distributed
        cluster: Any = None
        try:
            if self._address == "local":
                count = self._workers or os.cpu_count() or 1
                cluster = d.LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None, silence_logs=50)
            client = d.Client(cluster or self._address, timeout="5s", set_as_default=False)
        except (OSError, ValueError, TypeError) as wrong:
            raise BadInput(f"--dask {self._address}: no scheduler answers there ({wrong})") from wrong
        try:
            yield from self._gather(client, work)
        finally:
            client.close(timeout=2)  # jobs that nobody waits for any more are given up
            if cluster is not None:
                cluster.close()

    def _gather(self, client: Any, work: Work) -> Iterator[tuple[Job, str]]:
        programs, asked = str(program().parent), collections.Counter[int]()

        def submitted(job: Job) -> Any:
            asked[job.number] += 1
            key = f"phare-{os.getpid()}-{time.time_ns()}-{job.number}"  # named anew: no earlier result is taken for it
            return client.submit(_on_worker, job, work.plan, str(work.folder), programs, key=key, pure=False)

        def ask_again(job: Job) -> None:
            # Dropped on the way, as when the connection broke and came back. Should the first one still be driven somewhere, each
            # writes beside and renames.
            if asked[job.number] >= _MOST_ASKED or not self._is_back(client):
                raise Failed(self._gone())
            jobs[submitted(job)] = job

        jobs = {submitted(job): job for job in work.jobs}
        last_s, told = time.monotonic(), False
        checked_s = last_s
        while jobs:
            time.sleep(_POLL_S)
            done = [future for future in jobs if future.status != "pending"]
            for future in done:
                last_s, told = time.monotonic(), False
                job = jobs.pop(future)
                why = self._why(future, work)
                if why is None:
                    ask_again(job)
                    continue
                future.release()  # a result that nobody holds is not made anew when its worker is lost later
                yield job, why
            if client.status != "running":
                raise Failed(self._gone())
            if time.monotonic() - max(last_s, checked_s) > _TELL_AFTER_S:
                checked_s = time.monotonic()
                for future in self._forgotten(client, list(jobs)):
                    ask_again(jobs.pop(future))
            if not told and time.monotonic() - last_s > _TELL_AFTER_S and not self._asked(lambda: client.scheduler_info()["workers"]):
                told = True
                work.tell(f"waiting: {self._address} has no worker")

    def _is_back(self, client: Any) -> bool:
        """The scheduler answers, or does so within the time that a client takes to find it again."""
        until_s = time.monotonic() + _BACK_WITHIN_S
        while client.status != "running" and client.status != "closed" and time.monotonic() < until_s:
            time.sleep(_POLL_S)
        return client.status == "running"

    def _gone(self) -> str:
        return f"--dask {self._address}: the scheduler is gone; the same command goes on from here"

    def _asked(self, question: Callable[[], Any]) -> Any:
        """The scheduler's answer; Failed where the way to it breaks off meanwhile."""
        try:
            return question()
        except (OSError, asyncio.CancelledError, concurrent.futures.CancelledError) as wrong:
            raise Failed(self._gone()) from wrong

    def _forgotten(self, client: Any, waiting: list[Any]) -> list[Any]:
        """Those of the futures waited for that the scheduler does not know: word that they were dropped may be lost."""
        try:
            states = client.sync(client.scheduler.get_task_status, keys=[future.key for future in waiting], callback_timeout=_ANSWER_S)
        except (OSError, asyncio.TimeoutError, asyncio.CancelledError, concurrent.futures.CancelledError):
            return []  # asked again later; whether the client is still there is looked at in each turn
        return [future for future in waiting if states[future.key] is None and future.status == "pending"]

    def _why(self, future: Any, work: Work) -> str | None:
        """Why the job failed; "": it did not. None: it was dropped, before its answer was fetched or while it was."""
        if future.status in ("cancelled", "lost"):
            return None
        try:
            if future.status != "error":
                return "" if future.result(_ANSWER_S) else f"a worker does not see {work.folder}"
            wrong = future.exception(_ANSWER_S)
        except (asyncio.CancelledError, concurrent.futures.CancelledError, TimeoutError, asyncio.TimeoutError):
            return None
        except OSError as broken:
            raise Failed(self._gone()) from broken
        if isinstance(wrong, self._distributed.scheduler.KilledWorker):
            return "its workers were lost, again and again"
        return f"{type(wrong).__name__}: {wrong}"
