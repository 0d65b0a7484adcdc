"""process: the examples run as they stand."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import phare

FOLDER = Path(__file__).resolve().parents[1] / "examples"


@pytest.mark.parametrize("name", sorted(file.name for file in FOLDER.glob("*.py")))
def test_it_runs_and_says_something(name, tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(FOLDER.parent)}
    done = subprocess.run([sys.executable, str(FOLDER / name)], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) >= 2


def test_the_example_plan_is_one():
    plan = phare.sweep.read_plan(phare.shipped_file("examples/sweep.toml"))
    assert len(plan.jobs) == 6 and plan.rank_by == "edge_5lx_m"
