"""Who runs the jobs of a sweep. Here: this machine. Others: dask_engine.py, slurm_engine.py."""

from __future__ import annotations

import os
import threading
from abc import ABC, abstractmethod
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterator

from .plan import Job, Plan
from .task import drive_job


@dataclass(frozen=True)
class Work:
    """What is to be done, and where rows are to lie."""

    plan: Plan
    jobs: list[Job]
    folder: Path
    tell: Callable[[str], None]  # a line for who watches


class Engine(ABC):
    """Runs jobs by task.drive_job, somewhere that sees the folder of the sweep under the same name."""

    @abstractmethod
    def run(self, work: Work) -> Iterator[tuple[Job, str]]:
        """Gives each job as it ends: with its row on the disk, or with the reason why there is none (else ""). Closed early, it
        leaves nothing running."""


class ThisMachine(Engine):
    """So many drives at a time; None: one for each processor."""

    def __init__(self, workers: int | None = None):
        self._workers = workers or os.cpu_count() or 1

    def run(self, work: Work) -> Iterator[tuple[Job, str]]:
        stop = threading.Event()
        with ThreadPoolExecutor(self._workers) as pool:
            jobs: dict[Future[None], Job] = {
                pool.submit(drive_job, job, work.plan, work.folder, tell=work.tell, stopped=stop.is_set): job for job in work.jobs
            }
            waiting = set(jobs)
            try:
                while waiting:
                    done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                    for future in done:
                        future.result()
                        yield jobs[future], ""
            except BaseException:
                stop.set()
                pool.shutdown(wait=False, cancel_futures=True)
                raise
