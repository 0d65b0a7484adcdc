"""unit: the file of other road users and where they are, as the drive has them."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import phare
from phare.control.road_users import Lane

from conftest import straight_lane


def test_a_file_of_road_users_is_read(tmp_path):
    file = tmp_path / "users.toml"
    file.write_text('[[road_user]]\nclass = "lorry"\ndirection = "same"\nstart_s_m = 100\nspeed_kmh = 72\n'
                    '[[road_user]]\nclass = "pedestrian"\ndirection = "standing"\nstart_s_m = 50\n')
    lorry, walker = phare.read_road_users(file)
    lane = straight_lane(tmp_path)
    assert (lorry.kind, lorry.speed_mps, lorry.pose(lane, 2.0).s_m, lorry.height_m) == ("lorry", 20.0, 140.0, 3.6)
    assert walker.pose(lane, 9.0).s_m == 50.0 and not walker.lights
    for name in ("low.ies", "high.ies", "tail.ies", "led.csv"):
        (tmp_path / name).write_text("")
    file.write_text('[[road_user]]\nlights = "high"\nlow_beam = "low.ies"\nhigh_beam = "high.ies"\n'
                    'tail_lamp = { file = "tail.ies", colour_temperature_k = 2000 }\nthird_brake_lamp = { spectrum = "led.csv" }\n'
                    '[[road_user]]\nlights = "off"\n[[road_user]]\nlights = false\n')
    assert [user.lights for user in phare.read_road_users(file)] == [True, False, False], "sensors see that there is light"


@pytest.mark.parametrize("line, why", [
    ("low_beam = { colour_k = 3000 }", "low_beam: unknown key colour_k"), ("tail_lamp = 3", "expected the name of a file, or a table"),
    ("speeed_kmh = 3", "unknown key speeed_kmh"), ('class = "tram"', "class tram"), ("start_s_m = '3'", "expected a float"),
    ("speed_kmh = -3", "expected 0 to 1000: direction"), ("width_m = 0", "expected 0.01 to 100"), ("to_s = inf", "expected -1e"),
    ("across_to_s = -1", "expected across_from_s or more"),
    ('lights = "full"', "lights full: expected one of off, low, high"), ("low_beam = 3", "low_beam = 3: expected the name of a file"),
    ('direction = "standing"\nspeed_kmh = 50', "who is standing has none"), ("from_s = 10\nto_s = 5", "expected from_s or more"),
    ("across_from_s = 3", "there is no across_kmh"), ('class = "deer"\nlights = true', "a deer has none"),
    ('direction = "up"', "direction up"), ("start_s_m = nan", "nan"),
    ("speeds = [[0, 80], [0, 70]]", "speeds: times do not rise"), ("speeds = [[0]]", "speeds: expected an array of arrays"),
    ("speeds = [[0, 1001]]", "speeds: a speed is outside"), ("speeds = [[0, 1]]\nspeed_kmh = 3", "speeds: there is speed_kmh, too"),
    ('speeds = [[0, 1]]\ndirection = "standing"', "speeds: who is standing has none"), ("brake = 1", "expected a bool"),
    ('class = "bicycle"\nbrake = true', "brake: a bicycle has no brake lamps"), ('path = ""', "path: expected the name"),
    ('class = "bicycle"\nlights = "high"', "lights: a bicycle has no high beam"), ('class = "bicycle"\nhigh_beam = "x"', "high_beam: a bicycle has no high beam"),
    ('class = "motorcycle"\nthird_brake_lamp = "x"', "a motorcycle has no third brake lamp"), ('class = "pedestrian"\nlow_beam = "x"', "a pedestrian has no headlamps"),
    ('low_beam = "none.ies"', "low_beam: .*none.ies: no such file"), ("tail_lamp = { colour_temperature_k = 100 }", "= 100: expected 1667 to 25000"),
    ("tail_lamp = { chromaticity_xy = [0.9, 0.9] }", r"x \+ y <= 1"), ("tail_lamp = { chromaticity_xy = [0.3, 0.3], colour_temperature_k = 2000 }", "one of"),
    ('path = "none.csv"', "path: .*none.csv: cannot be read"), ('path = "p.csv"\nspeed_kmh = 3', "speed_kmh: there is a path, too"),
])
def test_what_is_wrong_with_road_users_is_said(tmp_path, line, why):
    file = tmp_path / "users.toml"
    file.write_text(f"[[road_user]]\n{line}\n")
    with pytest.raises(phare.BadInput, match=f"users.toml:1: road_user 1: .*{why}"):
        phare.read_road_users(file)


def test_road_users_are_where_the_drives_own_reader_has_them():
    """tests/traffic/poses.csv, which tests/traffic/road_users_test.cpp is held to as well."""
    folder = Path(__file__).parents[2] / "tests/traffic"
    lane, users = Lane(folder / "bend_lane.csv"), phare.read_road_users(folder / "users.toml")
    table = pd.read_csv(folder / "poses.csv")
    assert set(table.user) == set(range(1, len(users) + 1)) and set(table.there) == {0, 1}
    for row in table.itertuples():
        user = users[row.user - 1]
        found = user.pose(lane, row.time_s)
        assert (found is not None) == bool(row.there)
        if found is not None:
            assert found.place_m == pytest.approx([row.x_m, row.y_m, row.z_m], rel=0, abs=1e-10)
            if user.across_mps == 0.0:
                turned = math.pi if user.direction == "oncoming" else 0.0
                assert found.heading_rad - turned == pytest.approx(row.lane_heading_rad, rel=0, abs=1e-13)


def test_speeds_and_recorded_ways_are_those_of_the_drives_own_reader():
    """tests/traffic/path_poses.csv, which tests/traffic/recorded_path_test.cpp is held to as well."""
    folder = Path(__file__).parents[2] / "tests/traffic"
    lane, users = Lane(folder / "bend_lane.csv"), phare.read_road_users(folder / "paths.toml")
    table = pd.read_csv(folder / "path_poses.csv")
    assert set(table.user) == set(range(1, len(users) + 1)) and set(table.there) == {0, 1} and set(table.brakes) == {0, 1}
    for row in table.itertuples():
        found = users[row.user - 1].pose(lane, row.time_s)
        assert (found is not None) == bool(row.there)
        if found is not None:
            assert [*found.place_m, found.s_m] == pytest.approx([row.x_m, row.y_m, row.z_m, row.s_m], rel=0, abs=1e-10)
            assert [found.heading_rad, found.speed_mps] == pytest.approx([row.heading_rad, row.speed_mps], rel=0, abs=1e-12)
            assert found.brakes == bool(row.brakes)


def test_a_recorded_way_is_the_monotone_cubic_of_another_program(tmp_path):
    """SciPy's PchipInterpolator, the same method of Fritsch and Butland."""
    from scipy.interpolate import PchipInterpolator

    random = np.random.default_rng(7)
    steps_s = random.uniform(0.05, 2.0, 40)
    time_s = np.cumsum(steps_s)
    s_m, offset_m = np.cumsum(steps_s * random.uniform(-3.0, 20.0, 40)), random.uniform(-2.0, 2.0, 40)
    pd.DataFrame({"s_m": s_m, "time_s": time_s, "offset_m": offset_m}).to_csv(tmp_path / "p.csv", index=False)
    (tmp_path / "users.toml").write_text('[[road_user]]\npath = "p.csv"\n')
    path = phare.read_road_users(tmp_path / "users.toml")[0].path
    curves = PchipInterpolator(time_s, s_m), PchipInterpolator(time_s, offset_m)
    for then_s in np.linspace(time_s[0], time_s[-1], 500):
        first, second, _, speed = path.at(float(then_s))
        # A few roundings of 2^-53 of some 500 m, for the speed over steps of 0.05 s and more: 1e-12 each.
        assert [first, second] == pytest.approx([float(curve(then_s)) for curve in curves], rel=0, abs=1e-10)
        assert speed == pytest.approx(math.hypot(*(float(curve(then_s, 1)) for curve in curves)), rel=0, abs=1e-10)


@pytest.mark.parametrize("text, why", [
    ("time_s,s_m,offset_m\n0,1,0\n0,2,0\n", "p.csv:3: time_s does not rise"), ("time_s,s_m\n0,1\n1,2\n", "p.csv:1: has no column offset_m"),
    ("s_m,offset_m\n0,1\n1,2\n", "p.csv:1: has no column time_s"), ("time_s,s_m,offset_m\n0,1,nan\n1,2,0\n", 'p.csv:2: "nan" is not a finite'),
    ("time_s,s_m,offset_m\n0,1,0\n", "p.csv: a path has at least two rows"), ("", "p.csv: has no header line"),
    ("time_s,s_m,offset_m,x_m\n0,1,0,1\n1,2,0,2\n", "one of both"), ("time_s\n0\n1\n", "has neither columns"),
    ('"time_s","s_m","offset_m"\n0,1,0\n1,2,0\n', "p.csv:1: has no column time_s"), ("time_s,s_m,offset_m\n0,1_0,0\n1,2,0\n", 'p.csv:2: "1_0" is not a finite'),
    ("time_s,s_m,offset_m\n0,infinity,0\n1,2,0\n", 'p.csv:2: "infinity" is not'), ("time_s,s_m,s_m\n0,1,0\n1,2,0\n", 'p.csv:1: column "s_m" comes twice'),
    ("time_s,s_m,offset_m\n0,1,0\n1,2\n", "p.csv:3: 2 cells"), ("time_s,s_m,offset_m\n0,0,0\n1,300,0\n", "p.csv:3: goes faster"),
])
def test_what_is_wrong_with_a_recorded_way_is_said(tmp_path, text, why):
    (tmp_path / "p.csv").write_text(text)
    (tmp_path / "users.toml").write_text('[[road_user]]\npath = "p.csv"\n')
    with pytest.raises(phare.BadInput, match=f"users.toml:1: road_user 1: path: .*{why}") as said:
        phare.read_road_users(tmp_path / "users.toml")
    assert str(said.value).count("p.csv") == 1
