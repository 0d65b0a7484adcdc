"""python3 -m phare.sweep.slurm_task PLAN FOLDER NUMBER: what a task of an array job does. Failures stand in its row and in its log."""

from __future__ import annotations

import sys
from pathlib import Path

from .plan import read_plan
from .task import drive_job


def main(plan_file: str, folder: str, number: str) -> None:
    """Drives job NUMBER of the plan into the sweep's folder."""
    plan = read_plan(plan_file)
    drive_job(plan.jobs[int(number) - 1], plan, Path(folder), tell=lambda line: print(line, file=sys.stderr, flush=True))


if __name__ == "__main__":
    main(*sys.argv[1:])
