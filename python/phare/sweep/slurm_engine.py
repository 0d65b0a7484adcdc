"""Runs a sweep's jobs as tasks of Slurm's array jobs, and waits for them.

Partition, account, time and the like are told by Slurm's own environment variables (SBATCH_PARTITION, SBATCH_TIMELIMIT, …). A task
that ends without a row (killed, node lost and not requeued) goes into one more array; a job that fails tries itself once more.
Nodes see the folder of the sweep, the plan's files, this Python with this package, and Phare's programs under the same names as here.
"""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterator

from ..errors import BadInput, Failed
from ..programs import program
from .engine import Engine, Work
from .plan import Job, job_hash
from .task import read_row

_ARRAYS = 2  # the second for tasks that ended without a row
_POLL_S = 1.0
_DISK_S = 5.0  # how long a row of a task that has ended may stay unseen on a shared disk


class Slurm(Engine):
    """at_a_time: tasks of an array that run together; None: as many as Slurm gives."""

    def __init__(self, at_a_time: int | None = None):
        for name in ("sbatch", "squeue", "scancel", "scontrol"):
            if shutil.which(name) is None:
                raise BadInput(f"--slurm: no program {name}: apt-get install slurm-client, and the cluster's slurm.conf")
        self._at_a_time = at_a_time

    def run(self, work: Work) -> Iterator[tuple[Job, str]]:
        name = "phare-" + hashlib.sha256(str(work.folder).encode()).hexdigest()[:12]
        _cancel(name)  # what a run of this sweep left that was killed
        logs = work.folder / "slurm"
        shutil.rmtree(logs, ignore_errors=True)
        logs.mkdir()
        try:
            left = list(work.jobs)
            for array in range(1, _ARRAYS + 1):
                missing = []
                for job, why in self._array(work, left, logs, name):
                    if why and array < _ARRAYS:
                        work.tell(f"job {job.number}: {why}; once more")
                        missing.append(job)
                    else:
                        yield job, why
                left = missing
                if not left:
                    break
        finally:
            _cancel(name)

    def _array(self, work: Work, jobs: list[Job], logs: Path, name: str) -> Iterator[tuple[Job, str]]:
        """Gives each job when its row is there, or when its task has ended without."""
        hashes = {job.number: job_hash(job, work.plan) for job in jobs}
        largest = _largest_array()
        tasks: dict[str, Job] = {}  # by ARRAY_INDEX, as squeue names them
        for first in range(0, len(jobs), largest):
            part = jobs[first : first + largest]
            array = self._submit(work, part, logs, name)
            tasks |= {f"{array}_{index}": job for index, job in enumerate(part, 1)}
        gone_s: dict[str, float] = {}
        while tasks:
            queued = _queued(name, work)
            for task, job in list(tasks.items()):
                if read_row(job, work.folder, hashes[job.number]) is not None:
                    del tasks[task]
                    yield job, ""
                elif queued is not None and task not in queued:
                    gone_s.setdefault(task, time.monotonic())
                    if time.monotonic() - gone_s[task] > _DISK_S:
                        del tasks[task]
                        yield job, f"its task {task} of Slurm ended without figures{_last_line(logs / f'{task}.txt')}"
            if tasks:
                time.sleep(_POLL_S)

    def _submit(self, work: Work, jobs: list[Job], logs: Path, name: str) -> str:
        """The number of the array."""
        script = logs / f"array-{jobs[0].number}-{time.time_ns()}.sh"
        numbers = " ".join(str(job.number) for job in jobs)
        package = str(Path(__file__).resolve().parents[2])
        script.write_text(
            f"#!/bin/sh\nset -- {numbers}\nshift $((SLURM_ARRAY_TASK_ID - 1))\n"
            f"export PHARE_BIN={shlex.quote(str(program().parent))} PYTHONPATH={shlex.quote(package)}${{PYTHONPATH:+:$PYTHONPATH}}\n"
            f"exec {shlex.join([sys.executable, '-m', 'phare.sweep.slurm_task', str(work.plan.file), str(work.folder)])} \"$1\"\n"
        )
        together = f"%{self._at_a_time}" if self._at_a_time else ""
        said = _slurm(
            "sbatch", "--parsable", "--requeue", f"--job-name={name}", f"--array=1-{len(jobs)}{together}",
            f"--output={logs}/%A_%a.txt", f"--chdir={Path.cwd()}", str(script),
        )
        if said.returncode:
            raise Failed(f"--slurm: sbatch: {said.stderr.strip() or f'exit code {said.returncode}'}")
        return said.stdout.strip().partition(";")[0]


def _slurm(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, capture_output=True, text=True, check=False)


def _cancel(name: str) -> None:
    _slurm("scancel", "--quiet", "--me", f"--name={name}")


def _largest_array() -> int:
    said = _slurm("scontrol", "show", "config")
    if said.returncode:
        raise Failed(f"--slurm: scontrol: {said.stderr.strip()}")
    sizes = [line.partition("=")[2].strip() for line in said.stdout.splitlines() if line.startswith("MaxArraySize")]
    size = int(sizes[0]) if sizes else 1001
    if size < 2:
        raise Failed("--slurm: this cluster has no array jobs (MaxArraySize)")
    return size - 1


def _queued(name: str, work: Work) -> set[str] | None:
    """Tasks that wait or run, as ARRAY_INDEX; None: Slurm does not answer now."""
    said = _slurm("squeue", "--noheader", "--array", "--me", f"--name={name}", "--format=%i")
    if said.returncode:
        work.tell(f"waiting: squeue: {said.stderr.strip()}")
        time.sleep(10 * _POLL_S)
        return None
    return set(said.stdout.split())


def _last_line(log: Path) -> str:
    try:
        lines = log.read_text(errors="replace").strip().splitlines()
    except OSError:
        return ""
    return f": {lines[-1]}" if lines else ""
