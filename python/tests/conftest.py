"""What the tests share: the package of this tree, the programs, one short drive."""

import fcntl
import importlib.util
import os
import site
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
for folder in (Path.cwd() / "bin", Path(__file__).resolve().parents[2] / "build" / "release" / "bin"):
    if "PHARE_BIN" not in os.environ and (folder / "phare").exists():
        os.environ["PHARE_BIN"] = str(folder)

import phare  # noqa: E402
from phare.control.road_users import Lane  # noqa: E402

SMALL = dict(size=(160, 90), more=["--audit-every", "0"])


def straight_lane(tmp_path: Path, heights=None) -> Lane:
    """1 km due x, level or with these heights every 10 m."""
    file = tmp_path / "lane.csv"
    z = np.zeros(101) if heights is None else heights
    rows = [f"{10 * i},{10 * i},0,{z[i]},0,0" for i in range(101)]
    file.write_text("s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n" + "\n".join(rows) + "\n")
    return Lane(file)


@pytest.fixture(scope="session")
def examples() -> Path:
    return phare.shipped_file("examples")


@pytest.fixture(scope="session")
def report(tmp_path_factory) -> phare.Report:
    """Four lockstep frames of the demo drive, on low beam."""
    return phare.drive(frames=4, out=tmp_path_factory.mktemp("drive") / "out", **SMALL)


@pytest.fixture(scope="session")
def moving(tmp_path_factory) -> Path:
    """A drive of ours at 20 m/s along the road of the demo, on low beam."""
    file = tmp_path_factory.mktemp("moving") / "moving.pcap"
    t = np.arange(0, 1.0, 0.02)
    lane = Lane(phare.generated_file("scenes/country_road_lane.csv"))
    place = np.array([lane.at(20 + 20 * time, 0.0)[0] for time in t])
    heading = lane.at(20, 0)[1]
    phare.write_drive(file, phare.poses(t, x_m=place[:, 0], y_m=place[:, 1], z_m=place[:, 2], yaw_rad=heading, speed_mps=20.0))
    return file


_FMPY = "FMPy==0.3.22"


@pytest.fixture(scope="session")
def python_with_fmpy() -> str:
    """A Python that has FMPy, which this one has then too: as installed, or in an environment of the build tree, made once."""
    if importlib.util.find_spec("fmpy") is not None:
        return sys.executable
    folder = Path(os.environ.get("PHARE_BIN", Path.cwd() / "bin")).parent / "oracle_fmpy"
    python = folder / "bin" / "python"
    with folder.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "made").exists():
            pip = [python, "-m", "pip", "install", "--disable-pip-version-check", "--retries", "1", "--timeout", "10", "-q", _FMPY]
            for words in ([sys.executable, "-m", "venv", "--clear", "--system-site-packages", folder], pip):
                done = subprocess.run(words, capture_output=True, text=True)
                if done.returncode != 0:
                    pytest.skip(f"no Python environment with FMPy: {(done.stderr or done.stdout).strip().splitlines()[-1]}")
            (folder / "made").write_text(_FMPY)
    site.addsitedir(str(folder / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"))
    return str(python)
