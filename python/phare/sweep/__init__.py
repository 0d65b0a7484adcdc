"""Sweeps: many drives from one plan, a table and a ranking page (docs/sweep.md).

    python3 -m phare.sweep plan.toml --out out/beams
"""

from .plan import Job, Measure, Plan, read_plan
from .runner import Outcome, run_plan

__all__ = ["Job", "Measure", "Outcome", "Plan", "read_plan", "run_plan"]
