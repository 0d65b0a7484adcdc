"""process: sweeps of short drives, stopped and gone on with. unit: plans."""

import fcntl
import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

import phare
from phare import sweep
from phare.sweep.job import command_of, drive_words
from phare.sweep.plan import job_hash

FIXED = '[fixed]\nframes = 2\nsize = "64x64"\n'
EDGE = '[[measure]]\nname = "edge_m"\nrange_lx = 5\ny_m = -1.75\n'


def plan_of(tmp_path: Path, text: str, name: str = "plan.toml") -> Path:
    file = tmp_path / name
    file.write_text(text)
    return file


def aims(tmp_path, examples, count):
    lamp = examples / "low_beam.ies"
    vary = f"[vary]\naim = {[round(-0.3 - 0.2 * i, 2) for i in range(count)]}\n"
    return plan_of(tmp_path, f'rank_by = "edge_m"\n{FIXED}lamp = "{lamp}"\n{vary}{EDGE}')


def run(plan, out, **more):
    return sweep.run_plan(sweep.read_plan(plan), out, progress=io.StringIO(), **more)


def test_measures_are_of_the_design_that_a_job_shows(tmp_path):
    plan = plan_of(tmp_path, FIXED + '[vary]\n"set.design" = [0, 1]\n' + EDGE + "z_m = 0.25\n")
    run(plan, tmp_path / "out", workers=1)
    table = pd.read_csv(tmp_path / "out" / "table.csv") if (tmp_path / "out" / "table.csv").exists() else pd.read_parquet(tmp_path / "out" / "table.parquet")
    rig = phare.shipped_file("rigs/country_road.toml")
    x = [[5.0 + 0.5 * i, -1.75, 0.25, -1.0, 0.0, 0.0] for i in range(591)]
    lux = {name: phare.measure(rig, x, design=name, reference=True) for name in ("halogen", "led")}
    farthest = [max(point[0] for point, lx in zip(x, lux[name]) if lx >= 5.0) for name in ("halogen", "led")]
    assert list(table.sort_values("set.design").edge_m) == farthest and farthest[0] != farthest[1]


# ---- plans


def test_a_grid_is_every_pair(tmp_path):
    plan = sweep.read_plan(plan_of(tmp_path, '[vary]\naim = [-1, -0.5]\nlevel = ["kinematic", "full"]\n'))
    assert [tuple(job.varied.values()) for job in plan.jobs] == [
        (-1, "kinematic"), (-1, "full"), (-0.5, "kinematic"), (-0.5, "full")
    ]


def test_a_latin_hypercube_has_one_value_in_each_part_and_repeats(tmp_path):
    text = 'kind = "latin-hypercube"\nseed = {}\nsamples = 20\n[vary]\nfriction = {{ from = 0.2, to = 1.0 }}\nlevel = ["kinematic", "full"]\n'
    one, same, other = (
        [job.varied for job in sweep.read_plan(plan_of(tmp_path, text.format(seed))).jobs] for seed in (3, 3, 4)
    )
    assert one == same != other
    assert sorted(int((values["friction"] - 0.2) / 0.04 + 1e-9) for values in one) == list(range(20))
    assert [values["level"] for values in one].count("full") == 10


def test_traffic_needs_no_law(tmp_path):
    (tmp_path / "cars.toml").write_text(phare.shipped_file("examples/column.toml").read_text())
    job = sweep.read_plan(plan_of(tmp_path, "[fixed]\ntraffic = 'cars.toml'\n[vary]\naim = [1]\n")).jobs[0]
    assert f"--traffic {tmp_path.resolve() / 'cars.toml'}" in command_of(job, None)


def test_traffic_is_in_the_drive_of_a_law_too(tmp_path):
    (tmp_path / "cars.toml").write_text(phare.shipped_file("examples/column.toml").read_text())
    job = sweep.read_plan(plan_of(tmp_path, "[fixed]\ntraffic = 'cars.toml'\nlaw = 'GlareFree'\n[vary]\naim = [1]\n")).jobs[0]
    words = drive_words(job)
    assert words["more"][-2:] == ["--traffic", str(tmp_path.resolve() / "cars.toml")] and words["sensors"].road_users == words["more"][-1]


def test_a_job_is_another_when_what_its_files_name_has_changed(tmp_path, monkeypatch):
    for name, text in (
        ("low.ies", "1"), ("car.toml", "2"), ("scene.gltf", '{"images": [{"uri": "a%20road.png"}, {"uri": "data:none"}]}'), ("a road.png", "9"), ("scene_lane.csv", "4"), ("way.csv", "5"), ("tail.ies", "6"), ("lamps.toml", 'file = "street.ies"'),
        ("street.ies", "7"), ("traffic.toml", '[[road_user]]\npath = "way.csv"\ntail_lamp = { file = "tail.ies" }\n'),
        ("ourlaw.py", "import phare\nfrom ourparts import one\nclass L(phare.Controller): pass\n"), ("led.csv", "8"),
    ):
        (tmp_path / name).write_text(text)
    (tmp_path / "ourparts").mkdir()
    (tmp_path / "ourparts" / "__init__.py").write_text("")
    (tmp_path / "ourparts" / "one.py").write_text("from . import two\n")
    (tmp_path / "ourparts" / "two.py").write_text("")
    (tmp_path / "aside.py").write_text("")
    rig = phare.Rig.shipped()
    rig.scene, rig.vehicle, rig.more["street_lamps"] = "scene.gltf", "car.toml", "lamps.toml"
    rig.designs[0].lamps[0].sources[0].file = "low.ies"
    rig.write(tmp_path / "rig.toml")
    monkeypatch.syspath_prepend(tmp_path)
    text = f'[fixed]\nrig = "rig.toml"\ntraffic = "traffic.toml"\nlamp = "low.ies,spectrum={tmp_path}/led.csv"\nlaw = "ourlaw:L"\n[vary]\naim = [1]\n'
    plan = sweep.read_plan(plan_of(tmp_path, text))
    before = job_hash(plan.jobs[0], plan)
    assert job_hash(plan.jobs[0], plan) == before
    for name in ("low.ies", "car.toml", "scene.gltf", "a road.png", "scene_lane.csv", "way.csv", "tail.ies", "street.ies", "ourlaw.py", "ourparts/one.py", "ourparts/two.py",
                 "led.csv"):
        file = tmp_path / name
        was = file.read_text()
        file.write_text(f"{was}\n# other\n")
        assert job_hash(plan.jobs[0], plan) != before, name
        file.write_text(was)
        assert job_hash(plan.jobs[0], plan) == before, name
    (tmp_path / "aside.py").write_text("# nobody imports it")
    assert job_hash(plan.jobs[0], plan) == before


def test_two_sweeps_at_once_need_two_folders(tmp_path):
    plan = sweep.read_plan(plan_of(tmp_path, "[vary]\naim = [1]\n"))
    out = tmp_path / "out"
    out.mkdir()
    held = os.open(out, os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)
    with pytest.raises(phare.BadInput, match="out: another sweep is at work there"):
        sweep.run_plan(plan, out)
    os.close(held)
    assert not any((out / "rows").iterdir())


def test_a_grid_of_too_many_jobs_is_refused_before_it_is_made(tmp_path):
    axes = "".join(f"'set.{name}' = {list(range(100))}\n" for name in "abcdef")
    with pytest.raises(phare.BadInput, match="plan.toml:1: vary: makes more than 1000000 jobs"):
        sweep.read_plan(plan_of(tmp_path, "[vary]\n" + axes))


@pytest.mark.parametrize("text, line", [
    ("# a plan\n\nfast = true\n", 3), ("[fixed]\nsize = '9x9'\n\n[vary]\n'aim' = 1\n", 5),
    ("name = 'x'\n[fixed]\nlamb = 1\n[vary]\naim = [1]\n", 3),
    ("kind = 'list'\n[[run]]\naim = 1\n[[run]]\nlevel = 'full'\nlamp = 'none.ies'\n", 6),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\nat = [1, 2, 3]\n[[measure]]\nname = 'b'\n", 6),
])
def test_the_line_of_a_plan_is_named(tmp_path, text, line):
    with pytest.raises(phare.BadInput, match=f"plan.toml:{line}: "):
        sweep.read_plan(plan_of(tmp_path, text))


def test_a_list_is_as_it_stands(tmp_path):
    plan = sweep.read_plan(plan_of(tmp_path, 'kind = "list"\n[[run]]\naim = -1\n[[run]]\nlevel = "full"\n'))
    assert [job.varied for job in plan.jobs] == [{"aim": -1}, {"level": "full"}] and plan.axes() == ["aim", "level"]


@pytest.mark.parametrize("text, why", [
    ("[vary]\nlamb = ['a']\n", "unknown key lamb"), ("kind = 'all'\n", "kind 'all'"), ("[vary]\naim = -1\n", "expected a list"),
    ("[vary]\nlamp = ['none.ies']\n", "none.ies is no file"), ("fast = true\n", "unknown key fast"), ("", "a list has"),
    ("kind = 'list'\n[vary]\naim = [1]\n", "a list has"), ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\n", "either at"),
    ("[vary]\naim = [1]\n[[measure]]\nat = [1, 2, 3]\n", "has no name"), ("rank = 'best'\n[vary]\naim = [1]\n", "rank 'best'"),
    ("kind = 'latin-hypercube'\n[vary]\naim = [1]\n", "samples"), ("[vary]\nsensor_delay_s = [0.1]\n", "give law"),
    ("samples = 7\n[vary]\naim = [1]\n", "samples is of a Latin hypercube"), ("seed = 3\n[vary]\naim = [1]\n", "seed is of a Latin"),
    ("[fixed]\naim = -1\n[vary]\naim = [1]\n", "aim is fixed, and varies"),
    ("kind = 'latin-hypercube'\nsamples = 2\n[vary]\naim = { from = 2, to = 1 }\n", "expected a list or"), ("[vary\n", "Expected"),
    ("fixed = 3\n", r"fixed = 3: expected a table"), ("vary = 3\n", "vary = 3: expected a table"), ("measure = 3\n", "measure = 3: expected"),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\nat = ['a', 1, 2]\n", "at = .*: expected finite numbers"),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\nat = 3\n", "at = 3: expected finite"),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\nrange_lx = 'x'\n", "range_lx = 'x': expected a finite"),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'a'\nrange_lx = 1\nbeams = ['dim']\n", "expected some of position, low"),
    ("[vary]\naim = [1]\n[[measure]]\nname = 'aim'\nrange_lx = 1\n", "'aim' is another column's name"), ("run = 3\n", "run = 3: expected"),
    ("kind = 'latin-hypercube'\nsamples = true\n[vary]\naim = [1]\n", "samples = 1 to"), ("name = 3\n", "name = 3: expected a text"),
    ("kind = 'latin-hypercube'\nsamples = 2\nseed = -1\n[vary]\naim = [1]\n", "seed = -1: expected a whole"),
    ("kind = 'latin-hypercube'\nsamples = 2\n[vary]\naim = { from = 'a', to = 'b' }\n", "expected a list or"),
    ("[fixed]\nframes = 'two'\n[vary]\naim = [1]\n", "frames = 'two': expected a whole number"),
    ("[fixed]\nlevel = 'foo'\n[vary]\naim = [1]\n", "level = 'foo': expected one of pose, kinematic"),
    ("[vary]\naim = [-1, 'abc']\n", "job 2: aim = 'abc': expected cut-off, as-filed or degrees"),
    ("[fixed]\nsize = '1280'\n[vary]\naim = [1]\n", "size = '1280': expected WIDTHxHEIGHT"),
    ("[vary]\nroughness = ['A', 'F']\n", "roughness = 'F': expected a class"),
    ("[fixed]\nlaw = 'a:B'\nsensor_miss_01 = 2\n[vary]\naim = [1]\n", "sensor_miss_01 = 2: expected a number from 0 to 1"),
    ("rank_by = 'glare_s'\n[vary]\naim = [1]\n", "rank_by 'glare_s' is no column"),
    ("rank_by = 'high_share'\n[vary]\naim = [1]\n", "is no column"), ("rank_by = 'level'\n[vary]\nlevel = ['full']\n", "no column of numbers"),
    ("rank_by = 'edge'\n[vary]\naim = [1]\n", "rank_by 'edge' is no column of the table; there are aim, frames"),
])
def test_what_is_wrong_with_a_plan_is_said(tmp_path, text, why):
    with pytest.raises(phare.BadInput, match=rf"plan.toml(:\d+)?: .*{why}"):
        sweep.read_plan(plan_of(tmp_path, text))


# ---- runs


def test_a_sweep_stopped_and_gone_on_with_gives_the_same_table(tmp_path, examples):
    plan = aims(tmp_path, examples, 3)
    whole = run(plan, tmp_path / "whole")
    assert whole.ran == 3 and whole.failed == []
    assert whole.table.edge_m.is_monotonic_decreasing  # the further down, the shorter
    assert whole.table.picture_hash.nunique() == 3

    out = tmp_path / "stopped"
    environment = {**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])}
    command = [sys.executable, "-m", "phare.sweep", str(plan), "--out", str(out), "--workers", "1"]
    running = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + 120
    while len(list((out / "rows").glob("*.json"))) < 1 and running.poll() is None and time.monotonic() < until:
        time.sleep(0.02)
    running.send_signal(signal.SIGKILL)  # in the middle of the second
    running.wait()
    assert not (out / "table.csv").exists()
    gone_on = run(plan, out)
    assert 1 <= gone_on.ran <= 2
    assert gone_on.file.read_bytes() == whole.file.read_bytes()
    assert not list((out / "jobs").glob("*.making-*"))
    assert run(plan, out).ran == 0  # nothing is left to do
    page = gone_on.page.read_text()
    again = [str(phare.program()), *whole.table.command[1].split()[1:-1], str(tmp_path / "again")]
    subprocess.run([*again, "--port-base", str(phare.free_ports())], check=True, capture_output=True)
    assert phare.Report(tmp_path / "again").picture_hash == whole.table.picture_hash[1]
    assert page.count("phare drive --headless --lockstep") == 3 and "<svg" in page and "http" not in page


def test_a_job_that_fails_is_told_tried_again_and_ends_nothing(tmp_path, examples):
    (tmp_path / "broken.ies").write_text("IESNA:LM-63-2002\nnothing\n")
    lamps = [str(tmp_path / "broken.ies"), str(examples / "low_beam.ies")]
    plan, said = sweep.read_plan(plan_of(tmp_path, f"{FIXED}[vary]\nlamp = {lamps}\n{EDGE}")), io.StringIO()
    done = sweep.run_plan(plan, tmp_path / "out", progress=said)
    assert done.failed == [1] and "broken.ies" in done.table.error[0]
    assert said.getvalue().count("job 1: ") == 2 and "once more" in said.getvalue()
    assert done.table.edge_m[1] > 20 and "1 without figures" in done.page.read_text()
    (tmp_path / "broken.ies").write_bytes(Path(lamps[1]).read_bytes())  # mended: it alone is driven again
    again = run(tmp_path / "plan.toml", tmp_path / "out")
    assert again.ran == 1 and again.failed == [] and again.table.edge_m[0] == again.table.edge_m[1]


def test_a_law_is_an_axis(tmp_path):
    traffic = plan_of(tmp_path, '[[road_user]]\nstart_s_m = 150\nspeed_kmh = 60\noffset_m = 3.5\n', "traffic.toml")
    rig = phare.shipped_file("rigs/matrix.toml")
    text = f'{FIXED}rig = "{rig}"\ntraffic = "{traffic}"\n[vary]\nlaw = ["AutomaticHighBeam", "GlareFree"]\n'
    done = run(plan_of(tmp_path, text), tmp_path / "out", workers=2)
    assert done.failed == [] and list(done.table.high_share) == [0.0, 0.0]  # the car stands at first
    assert list(done.table.glare_s) == [0.0, 0.0] and (tmp_path / "out" / "jobs" / "00001" / "glare.html").exists()
    assert "phare.sweep" in done.table.command[0] and "--only 1" in done.table.command[0]
    with pytest.raises(phare.BadInput, match="law Bright"):
        sweep.job.law_named("Bright")
    assert isinstance(done.table, pd.DataFrame)


def test_the_command_line_says_what_is_wrong(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])}

    def say(*words):
        return subprocess.run([sys.executable, "-m", "phare.sweep", *words], env=environment, capture_output=True, text=True)

    said = say(str(tmp_path / "none.toml"))
    assert said.returncode == 2 and "none.toml: No such file" in said.stderr
    plan = plan_of(tmp_path, "[vary]\naim = [-1, 1]\n")
    assert say(str(plan), "--workers", "0").returncode == 2
    listed = say(str(plan), "--list")
    assert listed.returncode == 0 and listed.stdout.count("phare drive") == 2
    assert say(str(plan), "--only", "9", "--out", str(tmp_path / "o")).returncode == 2


@pytest.mark.parametrize("code, why", [
    ("import phare\nclass L(phare.Controller):\n    def __init__(self): raise ValueError('boom')\n", "law {0}:L: ValueError: boom"),
    ("x = = 1\n", "law {0}:L: SyntaxError: invalid syntax"),
])
def test_a_law_that_cannot_be_made_fails_its_job_alone(tmp_path, monkeypatch, code, why):
    name = "law_boom" if "boom" in code else "law_syntax"
    (tmp_path / f"{name}.py").write_text(code)
    monkeypatch.syspath_prepend(tmp_path)
    done = run(plan_of(tmp_path, f'{FIXED}[vary]\nlaw = ["{name}:L", "BendingLight"]\n'), tmp_path / "out")
    assert done.failed == [1] and why.format(name) in done.table.error[0] and done.table.frames[1] == 2


def test_a_parquet_table_reads_back_as_it_was(tmp_path):
    pytest.importorskip("pyarrow", reason="table.parquet is not tried: needs pip install pyarrow")
    # As jobs leave them: words and numbers in one column, a whole number missing, an error in one row alone.
    rows = [{"job": 1, "aim": "cut-off", "edge_m": 0.1, "frames": 2}, {"job": 2, "aim": -0.3, "error": "lamp.ies:2: odd"}]
    file = sweep.runner._write_table(pd.DataFrame(rows), tmp_path)
    assert file == tmp_path / "table.parquet" and not (tmp_path / "table.csv").exists()
    back = pd.read_parquet(file)
    assert list(back.columns) == ["job", "aim", "edge_m", "frames", "error"] and list(back.aim) == ["cut-off", "-0.3"]
    assert list(back.job) == [1, 2] and back.edge_m[0] == 0.1 and back.edge_m.isna()[1] and back.error.isna()[0]
    assert back.error[1] == "lamp.ies:2: odd"


def test_a_reader_that_leaves_is_no_error(tmp_path):
    plan = plan_of(tmp_path, "[vary]\naim = [" + ", ".join(f"{-n / 1000}" for n in range(1500)) + "]\n")  # more than a pipe holds
    environment = {**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])}
    command = [sys.executable, "-m", "phare.sweep", str(plan), "--list"]
    listing = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert b"phare" in listing.stdout.readline()
    listing.stdout.close()
    assert (listing.wait(timeout=60), listing.stderr.read()) == (141, b"")
