"""reference: lux at road users against a figure by hand. process: a slower camera is judged worse."""

import math

import numpy as np
import pandas as pd
import pytest

import phare
from phare.control.road_users import Lane
from phare.judge import judge_glare, judged, limit_lx, receptors_of
from phare.laws import GlareFree

from conftest import SMALL, straight_lane


def test_the_limits_are_those_of_the_table():
    assert [limit_lx(r, True) for r in (14.9, 15, 29.9, 30, 60, 119.9, 120, 220, 221)] == [
        None, 3.1, 3.1, 1.8, 0.6, 0.6, 0.3, 0.3, None
    ]
    assert [limit_lx(r, False) for r in (20, 59, 60, 120)] == [18.9, 18.9, 4.0, None]


@pytest.fixture(scope="module")
def approach(tmp_path_factory):
    """0.5 s at 20 m/s on the straight beginning of the demo's road, and a lamp that shines 1,000 cd everywhere."""
    folder = tmp_path_factory.mktemp("approach")
    lane, t = Lane(phare.generated_file("scenes/country_road_lane.csv")), np.arange(0, 0.6, 0.02)
    place = np.array([lane.at(20 + 20 * time, 0.0)[0] for time in t])
    phare.write_drive(folder / "straight.pcap", phare.poses(
        t, x_m=place[:, 0], y_m=place[:, 1], z_m=place[:, 2], yaw_rad=lane.at(20, 0)[1], speed_mps=20.0))
    lines = ["V\\H,-40,40", "-30,1000,1000", "30,1000,1000"]
    (folder / "even.csv").write_text("# quantity: luminous intensity\n# unit: cd\n# angles: type A\n" + "\n".join(lines) + "\n")
    rig = phare.Rig.shipped("matrix")
    lamp = rig.designs[0].lamps[0]
    lamp.sources = [phare.Source("low", str(folder / "even.csv")), phare.Source(
        "high", str(phare.shipped_file("examples/high_beam.ies")), pitch_deg=-0.573)]
    return folder, rig


class Half(phare.Controller):
    """The high beam of the left lamp at a half, that of the right one dark, both turned and levelled."""

    def step(self, given):
        left, right = phare.LampLight(0.1, 0.0, [1.0, 0.5]), phare.LampLight(0.0, 0.02, [1.0, 0.0])
        return phare.Answer("high", levelling_rad=0.01, lamps={"headlamp left": left, "headlamp right": right})


def test_lux_is_that_of_each_source_as_the_law_had_it(approach):
    folder, rig = approach
    users = [phare.RoadUser(start_s_m=90.0, speed_mps=0.0, offset_m=3.5)]
    report = phare.drive(rig, drive=folder / "straight.pcap", frames=3, controller=Half(), **SMALL)
    glare = judge_glare(report, rig, users)
    assert list(glare.moments.time_s.round(6)) == [0.0, round(1 / 60, 6), round(2 / 60, 6)]
    # The eye of who sits 0.35 m to the left of the middle, 1.2 m high, in the frame of the car, which stands level at 20 m. 1,000 cd of
    # each lamp, and of the left one half of what a beam gives there that is turned and aimed so.
    lane = Lane(phare.generated_file("scenes/country_road_lane.csv"))
    (car, yaw), (other, heading) = lane.at(20, 0.0), lane.at(90, 3.5)
    way = other + [0.35 * math.sin(heading), -0.35 * math.cos(heading), 1.2] - car
    eye = np.array([math.cos(yaw) * way[0] + math.sin(yaw) * way[1], math.cos(yaw) * way[1] - math.sin(yaw) * way[0], way[2]])
    normal = [-math.cos(heading - yaw), -math.sin(heading - yaw), 0.0]
    turned = phare.Mounted(
        phare.shipped_file("examples/high_beam.ies"), 3.45, 0.62, 0.66, yaw_deg=math.degrees(0.1), pitch_deg=math.degrees(0.01) - 0.573)
    expected = 0.5 * phare.measure(turned, [[*eye, *normal]], reference=True)[0]
    straight = phare.Mounted(turned.lamp, 3.45, 0.62, 0.66, pitch_deg=-0.573)
    assert abs(0.5 * phare.measure(straight, [[*eye, *normal]], reference=True)[0] - expected) > 0.1  # a turn forgotten shows
    for y in (0.62, -0.62):
        ray = eye - np.array([3.45, y, 0.66])
        r = np.linalg.norm(ray)
        expected += 1000.0 * -(ray / r @ normal) / r**2
    # Both in float64; the drive's poses are written as doubles.
    assert glare.moments.lx[0] == pytest.approx(expected, rel=1e-6)
    assert glare.moments.range_m[0] == pytest.approx(math.hypot(eye[0] - 3.45, eye[1]))
    assert glare.moments.above.all() and glare.judged_s == glare.above_s == pytest.approx(3 / 60)  # 2.7 lx, where 0.6 are the limit
    row = glare.bins[(glare.bins.receptor == "oncoming") & (glare.bins.from_m == 60)].iloc[0]
    assert row.most_lx == round(float(glare.moments.lx.max()), 1) and not row.passed
    glare.write_page(folder / "glare.html")
    assert "road user 1, oncoming" in (folder / "glare.html").read_text()


def test_a_slower_camera_is_judged_worse(approach):
    folder, _ = approach
    rig = phare.Rig.shipped("matrix")
    # It appears at 0.1 s, 60 m ahead, and is dazzled until the camera has answered.
    users = [phare.RoadUser(start_s_m=85.0, speed_mps=10.0, offset_m=3.5, from_s=0.1)]
    above = {}
    for delay_s in (0.0, 0.2):
        sensors = phare.Sensors(users, delay_s=delay_s)
        report = phare.drive(rig, drive=folder / "straight.pcap", frames=20, controller=GlareFree(), sensors=sensors, **SMALL)
        above[delay_s] = judge_glare(report, rig, users).above_s
    assert above[0.0] == 0.0
    assert above[0.2] == pytest.approx(0.2, abs=1.5 / 60)


def passing(cd: float, y_m: float, oncoming: bool) -> pd.DataFrame:
    """A receptor beside the car's axis from 110 m to 40 m before its lamps, and `cd` towards it from their middle."""
    rows = []
    for frame, ahead_m in enumerate(np.arange(110.0, 40.0, -0.4)):
        r = math.sqrt(ahead_m**2 + y_m**2 + 0.54**2)
        rows.append([frame, frame / 60, 1, oncoming, 0, 3.45 + ahead_m, y_m, 1.2, -1.0, 0.0, 0.0, math.hypot(ahead_m, y_m), cd * ahead_m / r**3])
    return pd.DataFrame(rows, columns=["frame", "time_s", "user", "oncoming", "receptor", "x", "y", "z", "nx", "ny", "nz", "range_m", "lx"])


@pytest.mark.parametrize("cd, y_m, oncoming, lines", [
    # Both sides together: half the sum is held against the line. 2.9 m to the left are 3.3 degrees at 50 m, 1.7 at 100 m.
    (1249.0, 2.9, True, [(50.0, 625.0, True), (100.0, 1750.0, True)]),
    (1251.0, 2.9, True, [(50.0, 625.0, False), (100.0, 1750.0, True)]),
    # Straight ahead, and 1.2 m to the right (1.4 and 0.7 degrees), where the limits of the same distances are others.
    (4000.0, 0.0, False, [(50.0, 1850.0, False), (100.0, 5300.0, True)]),
    (4000.0, -1.2, False, [(50.0, 2500.0, True), (100.0, 7000.0, True)]),
    # 6 m to the left are 6.8 degrees at 50 m and 3.4 at 100 m: the lines say nothing.
    (1e6, 6.0, True, []),
])
def test_candela_are_held_against_the_lines_of_the_regulation(cd, y_m, oncoming, lines):
    un = judged(passing(cd, y_m, oncoming), 1 / 60).un
    assert [(row.at_m, row.limit_cd, row.passed) for row in un.itertuples()] == lines
    assert all(row.most_cd == pytest.approx(cd / 2, rel=1e-9) for row in un.itertuples())


def test_the_share_of_time_in_glare():
    glare = judged(passing(1500.0, 2.9, True), 1 / 60)
    # 1,500 cd: over 0.6 lx, rounded to a tenth, up to sqrt(1500 / 0.65) = 48 m of those between 60 and 110; below 60 m 1.8 lx hold.
    assert glare.share_01 == 0.0 and glare.judged_s == pytest.approx(175 / 60)
    brighter = judged(passing(6000.0, 2.9, True), 1 / 60)
    # Up to sqrt(6000 / 0.65) = 96 m, and nearer than sqrt(6000 / 1.85) = 57 m: of 40 to 110 m in steps of 0.4 m.
    expected = ((96.07 - 60) + (56.95 - 40)) / 70
    assert brighter.share_01 == pytest.approx(expected, abs=3 * 0.4 / 70)


def test_drivers_and_riders_are_judged_by_what_they_have(tmp_path):
    """Two places each: it comes towards us 60 m ahead, it goes before us 60 m ahead."""
    car = pd.DataFrame(dict(frame_index=[0], x_m=0.0, y_m=0.0, z_m=0.0, roll_rad=0.0, pitch_rad=0.0, yaw_rad=0.0), index=[0.0])
    found = {}
    for kind in ("car", "lorry", "motorcycle", "bicycle", "pedestrian", "deer"):
        users = [phare.RoadUser(kind, direction, 60.0, lights=kind not in ("pedestrian", "deer")) for direction in ("oncoming", "same")]
        rows = receptors_of(car, straight_lane(tmp_path), users)
        found[kind] = [int((rows.user == user).sum()) for user in (1, 2)]
    assert found == {"car": [1, 3], "lorry": [1, 3], "motorcycle": [1, 2], "bicycle": [1, 0], "pedestrian": [0, 0], "deer": [0, 0]}
    rider = receptors_of(car, straight_lane(tmp_path), [phare.RoadUser("motorcycle", "oncoming", 60.0)])
    assert rider.y[0] == 0.0 and rider.z[0] == 1.35


@pytest.fixture(scope="module")
def by_led(tmp_path_factory, moving):
    """The demo's second design, shown by a setting, whatever the cockpit has."""
    return phare.drive(drive=moving, frames=3, settings={"design": 1}, out=tmp_path_factory.mktemp("led") / "out", **SMALL)


USERS = [phare.RoadUser(start_s_m=90.0, speed_mps=0.0, offset_m=3.5)]


def test_the_design_that_was_driven_is_judged(by_led, moving):
    rig = phare.Rig.shipped()
    lux = {name: judge_glare(by_led, rig, USERS, name).moments.lx.max() for name in (None, "halogen", "led")}
    assert lux[None] == lux["led"] != lux["halogen"]
    named = phare.drive(rig, drive=moving, frames=3, more=["--design", "led", "--audit-every", "0"], size=(160, 90))
    assert judge_glare(named, rig, USERS).moments.lx.max() == lux["led"]
    seen = [phare.RoadUser(kind="pedestrian", direction="standing", start_s_m=70.0, offset_m=-1.6)]
    target = {name: phare.detect_pedestrians(by_led, rig, seen, name).moments.target_cdm2.max() for name in (None, "halogen", "led")}
    assert target[None] == target["led"] != target["halogen"]


def test_each_frame_is_judged_by_its_own_design(by_led):
    """A drive whose first picture is of the one and the others of the other, as a change by the cockpit has it."""
    rig, rows = phare.Rig.shipped(), pd.read_csv(by_led.folder / "drive.csv")
    rows.loc[0, "design"] = "halogen"
    both = phare.Report(by_led.folder)
    both.raw["processes"]["visual-0"]["designs"].append({"index": 0, "name": "halogen", "lit_s": 0.02, "in_the_stills": False})
    file = by_led.folder / "drive.csv"
    kept = file.read_text()
    rows.to_csv(file, index=False)
    try:
        moments = judge_glare(both, rig, USERS).moments
    finally:
        file.write_text(kept)
    one, other = (judge_glare(by_led, rig, USERS, name).moments.lx for name in ("halogen", "led"))
    assert list(moments.lx) == [one[0], other[1], other[2]]


def test_another_rig_than_was_driven_is_refused(by_led, tmp_path):
    def refused(rig, why, design=None):
        with pytest.raises(phare.BadInput, match=why):
            judge_glare(by_led, rig, USERS, design)

    refused(phare.Rig.shipped("matrix"), "no design led: the rig has")
    scaled, moved, fewer = (phare.Rig.shipped() for _ in range(3))
    scaled.design("led").lamps[0].sources[0].scale = 2.0
    refused(scaled, "was driven with headlamp left: low by led_low_rht.ies, scale 1; the rig has .* scale 2")
    fewer.design("led").lamps.pop()
    refused(fewer, "design led was driven with 6 sources, the rig has 4")
    file = tmp_path / "led_low_rht.ies"
    file.write_bytes(phare.generated_file("lamps/led_low_rht.ies").read_bytes() + b"\r\n")
    moved.design("led").lamps[0].sources[0].file = str(file)
    refused(moved, "led_low_rht.ies: is not what was driven as headlamp left of design led")
    town = phare.Rig.shipped()
    town.scene = "generated/scenes/town.glb"
    refused(town, "was driven in the scene country_road.glb, the rig has town.glb")


def test_a_law_is_judged_by_the_design_it_led(moving):
    class Straight(phare.Controller):
        def step(self, given):
            return phare.Answer()

    rig = phare.Rig.shipped()
    report = phare.drive(rig, drive=moving, controller=Straight(), frames=2, **SMALL)
    assert judge_glare(report, rig, USERS, "halogen").moments.lx.max() == judge_glare(report, rig, USERS).moments.lx.max()
    with pytest.raises(phare.BadInput, match="design led: the control law led halogen"):
        judge_glare(report, rig, USERS, "led")


def test_nobody_there_is_no_glare(report):
    glare = judge_glare(report, phare.Rig.shipped(), [])
    assert glare.above_s == glare.judged_s == 0.0 and glare.moments.empty and isinstance(glare.bins, pd.DataFrame)
    assert list(glare.un.columns) == ["receptor", "at_m", "from_deg", "to_deg", "most_cd", "limit_cd", "passed"]
    by_file = judge_glare(report, phare.shipped_file("rigs/country_road.toml"), [])
    assert by_file.bins.equals(glare.bins)
    with pytest.raises(phare.BadInput, match="none.toml: No such file"):
        judge_glare(report, "none.toml", [])
    with pytest.raises(phare.BadInput, match="/none/glare.html: No such file"):
        glare.write_page("/none/glare.html")
