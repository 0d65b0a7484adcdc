"""unit: rigs as objects, held against the programs' reader."""

import copy
import tomllib

import pytest

import phare
from phare import toml_out


@pytest.mark.parametrize("name", ["country_road", "matrix"])
def test_a_shipped_rig_is_written_as_it_was_read(name, tmp_path):
    rig = phare.Rig.shipped(name)
    again = phare.Rig.read(rig.write(tmp_path / "again.toml"))
    assert again == rig
    assert again.problems() == []


def test_keys_the_class_does_not_name_stay(tmp_path):
    rig = phare.Rig.shipped()
    rig.more["keep_design"] = True
    rig.designs[0].lamps[0].sources[0].more["mirror"] = True
    again = phare.Rig.read(rig.write(tmp_path / "again.toml"))
    assert again.more["keep_design"] is True
    assert again.designs[0].lamps[0].sources[0].more == {"mirror": True}
    assert again.more["bus"]["port_base"] == 47000


def test_a_pair_is_two_lamps_by_name():
    assert phare.Rig.shipped("matrix").design("matrix").lamp_names() == ["headlamp left", "headlamp right"]
    with pytest.raises(phare.BadInput, match="the rig has matrix"):
        phare.Rig.shipped("matrix").design("laser")


def test_what_is_wrong_with_a_rig_is_said_by_the_program():
    rig = copy.deepcopy(phare.Rig.shipped())
    rig.designs[0].lamps[0].sources[0].file = "/nowhere/lamp.ies"
    problems = rig.problems()
    assert len(problems) == 1 and "/nowhere/lamp.ies" in problems[0]


def test_a_file_that_is_no_rig_is_refused_with_its_name(tmp_path):
    for text, why in (("scene = ", "Invalid value"), ("scene = 'a'\n", "missing"), ("scene = 3\n", "another kind")):
        (tmp_path / "bad.toml").write_text(text)
        with pytest.raises(phare.BadInput, match=f"bad.toml: .*{why}"):
            phare.Rig.read(tmp_path / "bad.toml")
    with pytest.raises(phare.BadInput, match="No such file"):
        phare.Rig.read(tmp_path / "none.toml")


def test_toml_keeps_every_kind_of_value():
    document = {
        "word": 'quote " back \\ line\n é \x7f', "whole": -3, "share": 1e-30, "flag": False, "list": [1.5, [2]], "empty": [],
        "a key": {"inner": {"deep": 1}}, "rows": [{"x": 1, "more": [{"y": 2}]}, {"x": 2}], "mixed": [[{"z": 1}]],
    }
    assert tomllib.loads(toml_out.dumps(document)) == document
    assert toml_out.dumps({"none": None}) == ""
    with pytest.raises(phare.BadInput):
        toml_out.dumps({"bad": float("nan")})


def test_the_road_users_of_a_rig_are_found_from_elsewhere(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "others.toml").write_text('[[road_user]]\nclass = "car"\ndirection = "oncoming"\nstart_s_m = 300\nspeed_kmh = 50\n')
    rig = phare.Rig.shipped()
    rig.more["traffic"] = "others.toml"
    rig.write(tmp_path / "far" / "rig.toml")
    again = phare.Rig.read(tmp_path / "far" / "rig.toml")
    assert again.more["traffic"] == str(tmp_path / "far" / "others.toml")
    assert phare.Rig.read(again.write(tmp_path / "rig.toml")).problems() == []
