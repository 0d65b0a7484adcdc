"""reference: lux at points against the photometric law, by hand."""

import base64
import json

import numpy as np
import pytest

import phare


def test_lux_is_intensity_by_the_square_of_the_distance(examples):
    lamp = phare.Lamp.read(examples / "low_beam.ies")
    # A wall 25 m ahead of the lamp, facing it: E = I cos(q) / r^2 with the direction's own r and q.
    h, v = np.radians([0.0, 1.5, -3.0]), np.radians([-1.0, -0.6, -2.0])
    y, z = -25 * np.tan(h), 25 * np.tan(v) / np.cos(h)
    points = np.column_stack([np.full(3, 25.0), y, z + 0.7, np.full(3, -1.0), np.zeros(3), np.zeros(3)])
    r = np.sqrt(25**2 + y**2 + z**2)
    expected = lamp.intensity(np.degrees(h), np.degrees(v)) * (25 / r) / r**2
    mounted = phare.Mounted(lamp, 0.0, 0.0, 0.7)
    np.testing.assert_allclose(phare.measure(mounted, points, reference=True), expected, rtol=1e-9)
    # The shader computes in float32: docs/accuracy.md has 4.4e-6 as its worst relative error.
    np.testing.assert_allclose(phare.measure(mounted, points), expected, rtol=1e-5)


def test_points_without_a_normal_lie_on_the_road_and_lamps_add_up(examples):
    pair = [phare.Mounted(examples / "low_beam.ies", 3.45, y, 0.66, pitch_deg=-0.573) for y in (0.62, -0.62)]
    lux = phare.measure(pair, [[20, 0, 0], [30, -1, 0]], reference=True, each=True)
    assert lux.shape == (2, 3)
    np.testing.assert_allclose(lux[:, 0], lux[:, 1] + lux[:, 2], rtol=1e-12)
    with_normal = phare.measure(pair, [[20, 0, 0, 0, 0, 1]], reference=True)
    assert with_normal[0] == lux[0, 0]


def test_points_with_and_without_a_normal_may_be_mixed(examples):
    lamp = phare.Mounted(examples / "low_beam.ies", 0, 0, 0.7)
    lux = phare.measure(lamp, [[50, -1.5, 0], [75, -1.5, 0.25, -1, 0, 0]], reference=True)
    each = [phare.measure(lamp, [point], reference=True)[0] for point in ([50, -1.5, 0], [75, -1.5, 0.25, -1, 0, 0])]
    assert lux.tolist() == each and phare.measure(lamp, (50, -1.5, 0), reference=True).tolist() == each[:1]


def test_a_rig_stands_for_its_lamps():
    rig = phare.shipped_file("rigs/country_road.toml")
    low, both = (phare.measure(rig, [[40, 0, 0]], beams=beams, reference=True) for beams in ("low", ["low", "high"]))
    assert both[0] > low[0] > 0


def test_a_lamp_is_mounted_as_it_was_read(examples, tmp_path):
    file, wall = examples / "low_beam.ies", [[25, -2, 0, -1, 0, 0], [25, 2, 0, -1, 0, 0]]
    plain, mirrored = (
        phare.measure(phare.Mounted(phare.Lamp.read(file, mirror=mirror), 3.45, 0, 0.66), wall, reference=True) for mirror in (False, True)
    )
    assert plain[0] != plain[1] and mirrored.tolist() == plain[::-1].tolist()
    phare.programs.run(["lamp", "convert", file, "--out", tmp_path / "low.ldt", "--out-axis", "gamma90"])
    turned = phare.Lamp.read(tmp_path / "low.ldt", axis="gamma90", c0_deg=0.0)
    # EULUMDAT has few digits: 1e-3 of the peak is what phare lamp convert promises of it.
    lux = phare.measure(phare.Mounted(turned, 3.45, 0, 0.66), wall, reference=True)
    np.testing.assert_allclose(lux, plain, rtol=0, atol=1e-3 * turned.peak_cd / 21.55**2)
    words = phare.Mounted(phare.Lamp("a.xml", {}, {"emitter": 2, "lamp_set": 3, "distance_m": 25.0}), 0, 0, 1).words()
    assert words == "a.xml,x=0.0,y=0.0,z=1.0,emitter=2,lamp_set=3,distance_m=25.0"


def test_a_rig_as_an_object_is_measured_as_its_file():
    file, points = phare.shipped_file("rigs/country_road.toml"), [[40, 0, 0], [60, -1, 0]]
    rig = phare.Rig.read(file)
    assert phare.measure(rig, points, design="led").tolist() == phare.measure(file, points, design="led").tolist()
    rig.designs[0].lamps[0].position_m[2] = 0.9
    assert phare.measure(rig, points)[0] != phare.measure(file, points)[0]


def test_a_scene_has_shadows(examples, tmp_path):
    # A square of 2 m upright 10 m ahead, from the ground: glTF has y up, and its -z is the left.
    corners = np.array([[10, 0, -1], [10, 0, 1], [10, 2, 1], [10, 2, -1]], "<f4").tobytes()
    raw = corners + np.array([0, 1, 2, 0, 2, 3], "<u2").tobytes()
    scene = tmp_path / "board.gltf"
    scene.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "board", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(raw), "uri": "data:application/octet-stream;base64," + base64.b64encode(raw).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [10, 0, -1], "max": [10, 2, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]}))
    lamp, wall = phare.Mounted(examples / "high_beam.ies", 0, 0, 1), [[20, 1.99, 1, -1, 0, 0], [20, 2.01, 1, -1, 0, 0]]
    bare, shaded = (phare.measure(lamp, wall, reference=True, scene=file) for file in (None, scene))
    assert bare[0] > 0 and shaded[0] == 0 and shaded[1] == bare[1] > 0


def test_what_cannot_be_measured_is_refused(examples):
    lamp = phare.Mounted(examples / "low_beam.ies", 0, 0, 1)
    for points, why in (([[1, 2]], r"point 0 is of shape \(2,\)"), ([[1, 2, 3], [1, 2, float("nan")]], "point 1 is not finite"),
                        ([[1, 2, 3], "abc"], "point 1"), (7, "points are 7"), ("1,2,3", "points are")):
        with pytest.raises(phare.BadInput, match=why):
            phare.measure(lamp, points)
    with pytest.raises(phare.BadInput, match="no lamp"):
        phare.measure([], [[1, 2, 3]])
    with pytest.raises(phare.BadInput, match="has no place: give Mounted"):
        phare.measure(phare.Lamp.read(examples / "low_beam.ies"), [[1, 2, 3]])
    with pytest.raises(phare.BadInput, match="Mounted: x is 'a'"):
        phare.measure(phare.Mounted(examples / "low_beam.ies", "a", 0, 1), [[1, 2, 3]])
    with pytest.raises(phare.BadInput, match="nix.ies"):
        phare.measure("nix.ies,x=0,y=0,z=1", [[1, 2, 3]])
    assert phare.measure(phare.Mounted(examples / "low_beam.ies", 0, 0, 1), np.zeros((0, 3))).shape == (0,)


@pytest.mark.parametrize("words", [{"design": "led"}, {"beams": "nonsense"}, {"beams": ["low"]}])
def test_beams_and_design_are_of_a_rig(examples, words):
    with pytest.raises(phare.BadInput, match=f"measure: {next(iter(words))} = .*: are of a rig file"):
        phare.measure(phare.Mounted(examples / "low_beam.ies", 3.45, 0.62, 0.66), [[40, 0, 0]], **words)
