"""reference: lux at points against the photometric law, by hand."""

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


def test_a_rig_stands_for_its_lamps():
    rig = phare.shipped_file("rigs/country_road.toml")
    low, both = (phare.measure(rig, [[40, 0, 0]], beams=beams, reference=True) for beams in ("low", ["low", "high"]))
    assert both[0] > low[0] > 0


def test_what_cannot_be_measured_is_refused(examples):
    with pytest.raises(phare.BadInput, match=r"shape \(1, 2\)"):
        phare.measure(phare.Mounted(examples / "low_beam.ies", 0, 0, 1), [[1, 2]])
    with pytest.raises(phare.BadInput, match="no lamp"):
        phare.measure([], [[1, 2, 3]])
    with pytest.raises(phare.BadInput, match="nix.ies"):
        phare.measure("nix.ies,x=0,y=0,z=1", [[1, 2, 3]])
    assert phare.measure(phare.Mounted(examples / "low_beam.ies", 0, 0, 1), np.zeros((0, 3))).shape == (0,)
