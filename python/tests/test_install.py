"""process: the package installs without network, and works from where it is installed."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

import phare

HERE = Path(__file__).resolve().parents[1]


@pytest.mark.skipif(importlib.util.find_spec("pip") is None, reason="no pip for this Python: apt install python3-pip")
def test_pip_installs_the_folder(tmp_path):
    source = tmp_path / "source"
    subprocess.run(["cp", "-r", str(HERE), str(source)], check=True)  # pip builds in the folder
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--no-index", "--no-build-isolation"]
    done = subprocess.run(
        [*pip, "--no-deps", "--no-cache-dir", "--target", str(tmp_path / "site"), str(source)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    code = "import phare, phare.laws, phare.sweep; print(phare.__file__); print(phare.Lamp.read(r'%s').peak_cd)"
    lamp = phare.shipped_file("examples/low_beam.ies")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site")}
    said = subprocess.run([sys.executable, "-c", code % lamp], capture_output=True, text=True, env=environment, cwd=tmp_path)
    assert said.returncode == 0, said.stderr
    assert str(tmp_path / "site") in said.stdout and (tmp_path / "site" / "phare" / "py.typed").exists()
