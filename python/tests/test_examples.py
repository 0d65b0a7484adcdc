"""process: the notebooks of python/examples run as they stand."""

import importlib.util
from pathlib import Path

import pytest

import phare

FOLDER = Path(__file__).resolve().parents[1] / "examples"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
_MISSING = [package for module, package in (("nbformat", "python3-nbformat"), ("nbclient", "python3-nbclient"), ("ipykernel", "python3-ipykernel"))
            if importlib.util.find_spec(module) is None]


@pytest.mark.skipif(bool(_MISSING), reason=f"notebooks need: apt-get install {' '.join(_MISSING)}")
@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs_and_shows_pictures(file, tmp_path, monkeypatch):
    import nbformat
    from nbclient import NotebookClient

    monkeypatch.setenv("PYTHONPATH", str(FOLDER.parent))
    notebook = nbformat.read(file, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "kept without what it shows"
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in shown) == 2
    assert sum(len(output.get("text", "").splitlines()) for output in shown) >= 2


def test_there_are_some():
    assert len(NOTEBOOKS) >= 2


def test_the_example_plan_is_one():
    plan = phare.sweep.read_plan(phare.shipped_file("examples/sweep.toml"))
    assert len(plan.jobs) == 6 and plan.rank_by == "edge_5lx_m"
