"""phare sweep: drives a plan, and leaves a table and a ranking page."""

from __future__ import annotations

import argparse
import os
import sys

from ..command_line import Parser, leave
from ..errors import BadInput, PhareError
from .dask_engine import Dask
from .job import command_of
from .plan import read_plan
from .runner import run_plan
from .slurm_engine import Slurm


def main() -> int:
    """Exit codes: 0 done, 1 a job has no figures, 2 bad input, 130 interrupted."""
    parser = Parser(
        prog="phare sweep", description="Drives every job of a plan: table, ranking page, each row with the command that repeats it.",
        epilog="Example:\n  phare sweep config/examples/sweep.toml --out out/sweep",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("plan", help="plan file (TOML, docs/sweep.md)")
    parser.add_argument("--out", default="out/sweep", help="folder of the sweep; one that was stopped goes on there [out/sweep]")
    parser.add_argument("--workers", type=int, help="drives at a time [one for each processor; with --slurm as many as it gives]")
    parser.add_argument("--only", type=int, metavar="NUMBER", help="this job alone, counted from 1")
    parser.add_argument("--list", action="store_true", help="print the command of each job, drive none")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--dask", metavar="ADDRESS", help="by Dask: tcp://HOST:PORT of a scheduler, or local for a cluster of its own here")
    where.add_argument("--slurm", action="store_true", help="by Slurm: an array job")
    options = parser.parse_args()
    engine = None
    try:
        if options.workers is not None and options.workers < 1:
            raise BadInput("--workers must be 1 or more")
        plan = read_plan(options.plan)
        if options.list:
            for job in plan.jobs:
                print(command_of(job, plan))
            return 0
        engine = Dask(options.dask, options.workers) if options.dask else Slurm(options.workers) if options.slurm else None
        done = run_plan(plan, options.out, workers=options.workers, only=options.only, engine=engine)
    except BadInput as wrong:
        print(f"phare sweep: {wrong}", file=sys.stderr)
        return 2
    except PhareError as wrong:
        print(f"phare sweep: {wrong}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("phare sweep: interrupted; the same command goes on from here", file=sys.stderr, flush=True)
        if engine is None:
            os._exit(130)  # without waiting for the drives, which were interrupted too
        return 130
    kind = "" if done.file.suffix == ".parquet" else " (CSV: Parquet needs pyarrow)"
    print(f"{done.ran} drives, {len(done.table) - done.ran} kept from before\n{done.file}{kind}\n{done.page}")
    if done.failed:
        print(f"phare sweep: without figures: job {', '.join(map(str, done.failed))}", file=sys.stderr)
    return 1 if done.failed else 0


if __name__ == "__main__":
    leave(main)
