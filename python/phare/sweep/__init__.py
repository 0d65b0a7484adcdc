"""Sweeps: many drives from one plan, a table and a ranking page (docs/sweep.md).

    python3 -m phare.sweep plan.toml --out out/beams
"""

from .dask_engine import Dask
from .engine import Engine, ThisMachine, Work
from .plan import Job, Measure, Plan, read_plan
from .runner import Outcome, run_plan
from .slurm_engine import Slurm

__all__ = [
    "Dask", "Engine", "Job", "Measure", "Outcome", "Plan", "Slurm", "ThisMachine", "Work", "read_plan", "run_plan",
]
