"""reference: distances and lux of a lamp that shines evenly, by hand."""

import math

import numpy as np
import pytest

import phare
from phare.edges import along, oncoming_glare, visibility


@pytest.fixture(scope="module")
def even(tmp_path_factory):
    """A rig with one lamp in the middle, 0.66 m high, 3.45 m ahead of the origin: 20,000 cd everywhere within 60 and 30 degrees."""
    folder = tmp_path_factory.mktemp("even")
    lines = ["# quantity: luminous intensity", "# unit: cd", "# angles: type A", "V\\H,-60,60", "-30,20000,20000", "30,20000,20000"]
    (folder / "even.csv").write_text("\n".join(lines) + "\n")
    rig = phare.Rig.shipped()
    lamp = phare.LampPlace("headlamp", [3.45, 0.0, 0.66], sources=[phare.Source("low", str(folder / "even.csv"))])
    rig.designs = [phare.Design("even", [lamp])]
    return rig.write(folder / "rig.toml")


def test_receptors_stand_beside_the_way_and_face_back_along_it():
    (right,) = along(150.0, np.array([150 * math.pi / 2]), -2.0, 0.25)  # a quarter of a circle to the left, outer side
    np.testing.assert_allclose(right, [152.0, 150.0, 0.25, 0.0, -1.0, 0.0], atol=1e-12)
    (left,) = along(-150.0, np.array([150 * math.pi / 2]), 2.0, 0.25)  # to the right: its mirror image
    np.testing.assert_allclose(left, [152.0, -150.0, 0.25, 0.0, 1.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(along(0.0, np.array([40.0]), 1.8, 1.1), [[40.0, 1.8, 1.1, -1.0, 0.0, 0.0]])


def test_the_distance_is_that_of_five_lux(even):
    table = visibility(even)
    assert len(table) == 10 and not table.open_end.any()
    # I cos q / r^2 = 5 lx is at some 63 m from the lamp: the last half metre at which it is not less.
    d = np.arange(5.0, 250.1, 0.5)
    for row in table.itertuples():
        aside = -1.8 if row.edge == "right edge" else 5.4 if row.approach == "straight" else 1.8
        at = along(0.0 if math.isinf(row.radius_m) else row.radius_m, d, aside, 0.25)
        way = at[:, :3] - [3.45, 0.0, 0.66]
        r = np.linalg.norm(way, axis=1)
        lux = np.maximum(20000 * -(way / r[:, None] * at[:, 3:]).sum(axis=1) / r**2, 0.0)
        assert row.distance_m == d[np.flatnonzero(lux >= 5)[-1]]
    straight = table[(table.approach == "straight") & (table.edge == "right edge")].distance_m.iloc[0]
    assert straight == pytest.approx(3.45 + math.sqrt(20000 / 5), abs=0.6)


def test_glare_is_told_over_the_distance(even):
    glare = oncoming_glare(even)
    assert list(glare.columns)[0] == "straight" and glare.index[0] == 10 and glare.index[-1] == 120
    way = np.array([50.0 - 3.45, 3.6, 1.1 - 0.66])
    r = np.linalg.norm(way)
    assert glare.straight[50.0] == pytest.approx(20000 * way[0] / r**3, rel=1e-9)


def test_nothing_lit_and_nonsense(even):
    assert (visibility(even, lx=1e6).distance_m == 0).all()
    with pytest.raises(phare.BadInput, match="-1 lx"):
        visibility(even, lx=-1)
