"""unit, process: an FMU, built here from python/examples/fmu, is the law; what cannot be one is told."""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import pytest

import phare
from phare.control import fmu_names
from phare.control.fmu import Fmu
from phare.laws import AutomaticHighBeam

from conftest import SMALL
from test_control import lamp, other

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "fmu"
PLATFORM = f"{os.uname().machine}-linux"
TIME = '<Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>'

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="no C compiler: apt-get install gcc")

CODE = """
#define fmi3DoStep plain_do_step
#define fmi3GetFloat64 no_float64
#include "high_beam.c"
#undef fmi3DoStep
#undef fmi3GetFloat64
FMI3_EXPORT int fmi3GetFloat64(fmi3Instance unit, const fmi3ValueReference* which, size_t count, double* values, size_t n) {
  (void)unit, (void)which, (void)count;
  for (size_t i = 0; i < n; ++i) values[i] = %(value)s;
  return fmi3OK;
}
FMI3_EXPORT int fmi3DoStep(fmi3Instance unit, double point_s, double step_s, bool none, bool* event, bool* end, bool* early, double* last) {
  int done = plain_do_step(unit, point_s, step_s, none, event, end, early, last);
  *end = %(ends)s;
  return done == fmi3OK ? %(status)s : done;
}
"""


@pytest.fixture(scope="module")
def unit(tmp_path_factory, python_with_fmpy) -> Path:
    file = tmp_path_factory.mktemp("unit") / "high_beam.fmu"
    subprocess.run([EXAMPLE / "build.sh", file], check=True, stdout=subprocess.DEVNULL)
    return file


def changed(unit: Path, to: Path, *replacements: tuple[str, str], binary: bytes | None = None, platform: str = PLATFORM) -> Path:
    """The example with these words of its description changed, and perhaps another binary."""
    with zipfile.ZipFile(unit) as whole:
        text = whole.read("modelDescription.xml").decode()
        binary = binary or whole.read(f"binaries/{PLATFORM}/high_beam.so")
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    with zipfile.ZipFile(to, "w") as made:
        made.writestr("modelDescription.xml", text)
        made.writestr(f"binaries/{platform}/high_beam.so", binary)
    return to


def compiled(tmp_path: Path, value="0.5", status="fmi3OK", ends="false") -> bytes:
    source, library = tmp_path / "unit.c", tmp_path / "unit.so"
    source.write_text(CODE % dict(value=value, status=status, ends=ends))
    subprocess.run(["gcc", "-std=c11", "-shared", "-fPIC", f"-I{EXAMPLE}", source, "-o", library], check=True)
    return library.read_bytes()


def output(name: str, size: int | None = None) -> tuple[str, str]:
    """A further output, Float64."""
    dimension = "/>" if size is None else f'><Dimension start="{size}"/></Float64>'
    return TIME, f'{TIME}<Float64 name="{name}" valueReference="9" causality="output" initial="calculated"{dimension}'


STRUCTURE = ('<Output valueReference="3"/>', '<Output valueReference="3"/><Output valueReference="9"/>')
UNKNOWN = ('<InitialUnknown valueReference="3"/>', '<InitialUnknown valueReference="3"/><InitialUnknown valueReference="9"/>')


def given_at(frame: int, **more) -> phare.Given:
    return phare.Given(frame, frame / 60, 1 / 60 if frame else 0.0, 20.0, lamps=[lamp()], **more)


def test_a_unit_answers_as_the_same_law_in_python(unit, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    fmu, law = Fmu(unit), AutomaticHighBeam()
    for _ in range(2):  # anew each time
        fmu.begin([lamp()])
        law.begin([lamp()])
        lights = []
        for frame in range(240):
            given = given_at(frame, objects=[other(200), other(100, lights="none")] if 60 <= frame < 90 else [])
            lights.append(fmu.step(given).light)
            assert lights[-1] == law.step(given).light
        assert lights[59] == "high" and lights[60] == "low" and lights[-1] == "high"
    fmu.begin([lamp()])  # one that has not been stepped is freed too
    assert len(list(tmp_path.glob("phare-fmu-*"))) == 1
    fmu.end()
    assert not list(tmp_path.glob("phare-fmu-*"))


def test_a_drive_by_a_unit_repeats_and_is_that_of_the_law_in_python(unit, moving, tmp_path, python_with_fmpy):
    traffic = [phare.RoadUser(start_s_m=200, speed_mps=20.0, offset_m=3.5, from_s=0.09)]
    package = Path(phare.__file__).parents[1]
    alone = phare.Program(["env", f"PYTHONPATH={package}", python_with_fmpy, "-m", "phare.laws.fmu", unit])
    driven = [
        phare.drive(drive=moving, controller=law, sensors=phare.Sensors(traffic), frames=12, out=tmp_path / str(n), **SMALL)
        for n, law in enumerate([Fmu(unit), Fmu(unit), AutomaticHighBeam(), alone])
    ]
    light = list(driven[0].law_steps.light)
    assert light[0] == "high" and light[-1] == "low" and light == sorted(light)  # off once, for who comes towards us
    assert len({report.picture_hash for report in driven}) == 1
    assert all(list(report.law_steps.light) == light for report in driven)
    assert driven[0].frame(0).mean() > driven[0].frame(-1).mean()


def test_what_a_unit_says_of_lamps_and_sources_is_followed(unit, tmp_path):
    binary = compiled(tmp_path, value="0.5 + 0.25 * (double)i")
    one = changed(unit, tmp_path / "one.fmu", output("sources.dimming_01", 3), STRUCTURE, UNKNOWN, binary=binary)
    law = Fmu(one)
    lamps = [lamp(columns=1), lamp("right", -0.6, columns=1)]
    law.begin(lamps)
    answer = law.step(phare.Given(speed_mps=20.0, lamps=lamps))
    law.end()
    assert answer.light == "high" and answer.levelling_rad == 0.0
    assert answer.lamps["left"].dimming_01 == [0.5, 0.75] and answer.lamps["right"].dimming_01 == [1.0, 1.0]
    turned = changed(unit, tmp_path / "turned.fmu", output("lamps[2].yaw_rad"), STRUCTURE, UNKNOWN, binary=binary)
    law = Fmu(turned)
    law.begin(lamps)
    answer = law.step(phare.Given(speed_mps=20.0, lamps=lamps))
    law.end()
    assert answer.lamps["left"].yaw_rad == 0.0 and answer.lamps["right"].yaw_rad == 0.5


def test_of_more_objects_than_a_unit_has_room_for_the_nearest_count(unit):
    law = Fmu(unit)
    law.begin([lamp()])
    dark = [other(100 + n, lights="none", id=n) for n in range(16)]
    assert law.step(given_at(0, objects=[other(200, id=20), *dark])).light == "high"
    assert law.step(given_at(1, objects=[other(99, id=20), *dark])).light == "low"
    law.end()


def test_every_fact_of_a_given_has_a_name():
    seen, given = other(50), given_at(3, objects=[other(90, id=7), other(50)], ahead=[phare.control.CurveAhead(10.0, 0.01)])
    items = fmu_names.items_of(given)
    assert [item.id for item in items["objects"]] == [1, 7]  # nearest first
    for name in phare.Given.__slots__:
        if name not in ("light", "objects", "ahead", "lamps"):
            assert fmu_names.SCALARS[name][1](given) == getattr(given, name)
    assert fmu_names.SCALARS["light_switch"][1](given) == 2
    for name in seen.__slots__:
        value = fmu_names.GROUPS["objects"][name][1](seen)
        assert value == {"kind": 1, "lights": 1}.get(name, getattr(seen, name))
    assert [fmu_names.GROUPS["sources"]["function"][1](item) for item in items["sources"][:2]] == [1, 2]
    assert fmu_names.input_named("objects[2].h_left_rad").element == 2
    for none in ("objects[0].x_m", "objects.colour", "light", "speed", "objects[1].count"):
        assert fmu_names.input_named(none) is None
    page = (Path(__file__).resolve().parents[2] / "docs" / "fmu-law.md").read_text()
    names = [*fmu_names.SCALARS, *fmu_names.OUTPUT_SCALARS]
    names += [name for group in fmu_names.GROUPS.values() for name in group]
    assert [name for name in names if f"`{name}`" not in page] == []


def refused(unit: Path, python: str = sys.executable) -> str:
    """What the command says of it; by exit code 2."""
    package = Path(phare.__file__).parents[1]
    said = subprocess.run(
        [python, "-m", "phare.laws.fmu", unit, "--list"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(package)}
    )
    assert said.returncode == 2 and "Traceback" not in said.stderr
    return said.stderr


@pytest.mark.parametrize("old, new, why", [
    ('name="light"', 'name="brightness"', "has no output that is known here"),
    ('<CoSimulation modelIdentifier="high_beam" canHandleVariableCommunicationStepSize="true"/>',
     '<ModelExchange modelIdentifier="high_beam"/>', "has no co-simulation"),
    ('<Int32 name="light"', '<String name="light"', "output light is String: expected Int32 or"),
    ('<Float64 name="speed_mps"', '<Int32 name="speed_mps"', "input speed_mps is Int32: expected Float64 or Float32"),
    ('<Dimension start="16"/>', "", "input objects.lights has 0 dimensions: expected an array of one dimension"),
    ('fmiVersion="3.0"', 'fmiVersion="2.0"', "is of FMI 2.0: expected 3.0"),
])
def test_a_unit_that_cannot_be_a_law_is_refused(unit, tmp_path, old, new, why):
    replacements = [(old, new)]
    if new.startswith("<Int32 name=\"speed"):
        replacements.append(('variability="continuous" start="0"', 'variability="discrete" start="0"'))
    with pytest.raises(phare.BadInput, match=f"unit.fmu: .*{why}"):
        Fmu(changed(unit, tmp_path / "unit.fmu", *replacements))


def test_the_command_ends_with_2_and_says_why(unit, tmp_path, python_with_fmpy):
    assert "no such file" in refused(tmp_path / "none.fmu", python_with_fmpy)
    (tmp_path / "text.fmu").write_text("no zip")
    assert "text.fmu: cannot be read as an FMU" in refused(tmp_path / "text.fmu", python_with_fmpy)
    other_machine = changed(unit, tmp_path / "other.fmu", platform="aarch64-windows")
    assert f"other.fmu: has no binary for this machine, binaries/{PLATFORM}" in refused(other_machine, python_with_fmpy)


@pytest.mark.parametrize("code, why", [
    (dict(status="fmi3Discard"), "fmi3DoStep failed with status 2"), (dict(status="fmi3Error"), "fmi3DoStep failed with status 3"),
    (dict(value="0.0 / 0.0"), "output levelling_rad is nan"), (dict(value="3.0"), "levelling_rad = 3.0"),
    (dict(ends="true"), "asked for the end"),
])
def test_a_unit_that_fails_on_the_way_is_told(unit, tmp_path, code, why):
    file = changed(unit, tmp_path / "unit.fmu", output("levelling_rad"), STRUCTURE, UNKNOWN, binary=compiled(tmp_path, **code))
    law = Fmu(file)
    law.begin([lamp()])
    with pytest.raises(phare.LawFailed, match=f"unit.fmu: at .* s: .*{why}"):
        for frame in range(3):
            law.step(given_at(frame))
    law.end()


@pytest.mark.parametrize("source, why", [
    (None, "Failed to load shared library"), ("int nothing;", "fmi3.* is missing in shared library"),
    ("#define calloc(a, b) NULL\n#include \"high_beam.c\"", "Failed to instantiate FMU"),
])
def test_a_unit_that_does_not_begin_is_told_and_leaves_nothing(unit, tmp_path, monkeypatch, source, why):
    binary = b"no library"
    if source is not None:
        (tmp_path / "unit.c").write_text(f"#include <stdlib.h>\n{source}\n")
        subprocess.run(["gcc", "-shared", "-fPIC", f"-I{EXAMPLE}", tmp_path / "unit.c", "-o", tmp_path / "unit.so"], check=True)
        binary = (tmp_path / "unit.so").read_bytes()
    law, here = Fmu(changed(unit, tmp_path / "unit.fmu", binary=binary)), Path.cwd()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(phare.LawFailed, match=f"unit.fmu: .*{why}"):
        law.begin([lamp()])
    assert Path.cwd() == here and not list(tmp_path.glob("phare-fmu-*"))


def test_a_unit_of_one_step_length_gets_no_other(unit, tmp_path):
    law = Fmu(changed(unit, tmp_path / "unit.fmu", (' canHandleVariableCommunicationStepSize="true"', "")))
    law.begin([lamp()])
    for frame in range(3):
        law.step(given_at(frame))
    with pytest.raises(phare.LawFailed, match="unit.fmu: .* takes steps of one length only"):
        law.step(given_at(5))
    law.end()


def test_what_a_unit_has_beyond_our_names_is_told(unit, tmp_path):
    law = Fmu(changed(unit, tmp_path / "unit.fmu", output("my_debug"), STRUCTURE, UNKNOWN))
    with pytest.warns(UserWarning, match="output my_debug"):
        law.begin([lamp()])
    law.end()


def test_a_plan_may_name_a_unit_and_drives_anew_when_it_changes(unit, tmp_path):
    from phare.sweep.job import law_named
    from phare.sweep.plan import job_hash, read_plan

    shutil.copy(unit, tmp_path / "mine.fmu")
    (tmp_path / "plan.toml").write_text('[fixed]\nframes = 2\n[vary]\nlaw = ["mine.fmu", "AutomaticHighBeam"]\n')
    plan = read_plan(tmp_path / "plan.toml")
    assert law_named(plan.jobs[0].settings["law"]).file == tmp_path / "mine.fmu"
    before = [job_hash(job, plan) for job in plan.jobs]
    changed(unit, tmp_path / "mine.fmu", ("example-high-beam-1", "example-high-beam-2"))
    after = [job_hash(job, plan) for job in plan.jobs]
    assert before[0] != after[0] and before[1] == after[1]
    (tmp_path / "mine.fmu").unlink()
    with pytest.raises(phare.BadInput, match="law: .*mine.fmu is no file"):
        read_plan(tmp_path / "plan.toml")


def test_in_real_time_the_unit_leads_with_steps_as_they_come(unit, moving):
    driven = phare.drive(drive=moving, controller=Fmu(unit), lockstep=False, **SMALL)
    told, steps = driven.figures["law"], driven.law_steps
    assert told["answers"] >= 1 and told["refused"] == 0 and 0 < told["delay_ms"]["median"] <= told["delay_ms"]["max"]
    assert steps.light.isin(["low", "high"]).all() and (steps.light == "high").any()  # 72 km/h and nobody there
    assert (steps.time_s.diff().dropna() > 0).all()
