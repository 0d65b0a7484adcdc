"""What the tests share: the package of this tree, the programs, one short drive."""

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
for folder in (Path.cwd() / "bin", Path(__file__).resolve().parents[2] / "build" / "release" / "bin"):
    if "PHARE_BIN" not in os.environ and (folder / "phare").exists():
        os.environ["PHARE_BIN"] = str(folder)

import phare  # noqa: E402

SMALL = dict(size=(160, 90), more=["--audit-every", "0"])


@pytest.fixture(scope="session")
def examples() -> Path:
    return phare.shipped_file("examples")


@pytest.fixture(scope="session")
def report(tmp_path_factory) -> phare.Report:
    """Four lockstep frames of the demo drive, on low beam."""
    return phare.drive(frames=4, out=tmp_path_factory.mktemp("drive") / "out", **SMALL)
