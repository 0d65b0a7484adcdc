"""Rig files as objects: read, changed, written, checked (docs/rig-file.md has every key)."""

from __future__ import annotations

import contextlib
import copy
import os
import tempfile
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from . import toml_out
from .errors import BadInput, told
from .programs import program, run_json
from .toml_in import read_toml

PathLike = str | os.PathLike[str]


def _known(cls: type, table: Mapping[str, Any], skip: Sequence[str] = ()) -> dict[str, Any]:
    """Fields of a class out of a table; the rest goes to `more`, so that nothing is lost."""
    names = {each.name for each in fields(cls)} - {"more", *skip}
    given = {key: value for key, value in table.items() if key in names}
    given["more"] = {key: value for key, value in table.items() if key not in names and key not in skip}
    return given


def _table(item: Any, **lists: Any) -> dict[str, Any]:
    """The table of an object: what is None or empty is left out."""
    table = {}
    for each in fields(item):
        value = getattr(item, each.name)
        if each.name != "more" and each.name not in lists and value is not None:
            table[each.name] = value
    return {**table, **item.more, **{key: value for key, value in lists.items() if value}}


def _each_emitter(table: dict[str, Any]) -> list[dict[str, Any]]:
    """Of a source that stands for several emitters of one file, a table each, as the programs read it."""
    count = table.get("emitters")
    if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count <= 1000 or "emitter" in table:
        return [table]  # phare rig check tells what is wrong
    rest = {key: value for key, value in table.items() if key != "emitters"}
    return [rest | {"emitter": number} for number in range(1, count + 1)]


_OF_SOURCE = ("pixels", "pixel_map", "spectrum")  # further files of one
_OF_RIG = ("traffic", "street_lamps")


@dataclass
class Source:
    """One photometry file in a lamp. Degrees: yaw left, pitch up, roll right side down. `more`: all other keys of
    [[design.lamp.source]]."""

    function: str  # position, low, high, fog, daytime, cornering
    file: str  # absolute once read; "generated/…" is what the build made
    yaw_deg: float | None = None
    pitch_deg: float | None = None
    roll_deg: float | None = None
    scale: float | None = None  # multiplies candela
    colour_temperature_k: float | None = None
    more: dict[str, Any] = field(default_factory=dict)


@dataclass
class LampPlace:
    """A lamp of a design: position in m (car frame: x forward, y left, z up), aim "as-filed", "cut-off" or degrees up."""

    name: str
    position_m: list[float]
    pair: bool | None = None  # the left one of two; the twin sits at -y
    aim: str | float | None = None
    sources: list[Source] = field(default_factory=list)
    more: dict[str, Any] = field(default_factory=dict)


@dataclass
class Design:
    """A named set of lamps."""

    name: str
    lamps: list[LampPlace] = field(default_factory=list)
    more: dict[str, Any] = field(default_factory=dict)

    def lamp_names(self) -> list[str]:
        """As the programs call them: a pair is "NAME left" and "NAME right"."""
        return [
            name
            for lamp in self.lamps
            for name in ([f"{lamp.name} left", f"{lamp.name} right"] if lamp.pair else [lamp.name])
        ]


@dataclass
class Channel:
    """A picture and its eye: m in the car's frame, degrees."""

    name: str | None = None
    width_px: int | None = None
    height_px: int | None = None
    fov_horizontal_deg: float | None = None
    eye_m: list[float] | None = None
    yaw_deg: float | None = None
    pitch_deg: float | None = None
    more: dict[str, Any] = field(default_factory=dict)


@dataclass
class Rig:
    """Which car, road, cockpit, pictures and lamps belong together."""

    scene: str
    vehicle: str
    cockpit: str
    designs: list[Design]
    channels: list[Channel] = field(default_factory=list)
    name: str | None = None
    more: dict[str, Any] = field(default_factory=dict)  # bus, clock, dynamics, eye, desk, beams, keep_design as in the file

    @classmethod
    def read(cls, file: PathLike) -> Rig:
        """Reads a rig file. Paths in it become absolute, but those under "generated/". Raises BadInput."""
        here = Path(file)
        document = read_toml(file)
        try:
            return cls._of(document, here.resolve().parent)
        except (KeyError, TypeError, AttributeError) as wrong:
            raise BadInput(f"{file}: a key is missing or of another kind ({wrong}); phare rig check tells which") from wrong

    @classmethod
    def _of(cls, document: dict[str, Any], folder: Path) -> Rig:
        def absolute(path: str) -> str:
            return path if os.path.isabs(path) or path.startswith("generated/") else os.path.normpath(folder / path)

        document = copy.deepcopy(document)
        for key in ("scene", "vehicle", "cockpit"):
            document[key] = absolute(document[key])
        for key in _OF_RIG:
            if document.get(key):
                document[key] = absolute(document[key])
        if document.get("bus", {}).get("key_file"):
            document["bus"]["key_file"] = absolute(document["bus"]["key_file"])
        designs = []
        for design in document.pop("design"):
            lamps = []
            for lamp in design.pop("lamp"):
                sources = [
                    Source(**_known(Source, s | {key: absolute(s[key]) for key in ("file", *_OF_SOURCE) if key in s}))
                    for table in lamp.pop("source")
                    for s in _each_emitter(table)
                ]
                lamps.append(LampPlace(**_known(LampPlace, lamp), sources=sources))
            designs.append(Design(**_known(Design, design), lamps=lamps))
        channels = [Channel(**_known(Channel, channel)) for channel in document.pop("channel", [])]
        return cls(**_known(cls, document, ("designs", "channels")), designs=designs, channels=channels)

    @classmethod
    def shipped(cls, name: str = "country_road") -> Rig:
        """A rig that comes with Phare: "country_road", "matrix" or "three_channels"."""
        return cls.read(shipped_file(f"rigs/{name}.toml"))

    def files(self) -> list[str]:
        """What it is read from beside itself: scene, vehicle, cockpit, traffic, street lamps, and the files of every source."""
        sources = [source for design in self.designs for lamp in design.lamps for source in lamp.sources]
        of_sources = [path for source in sources for path in (source.file, *(source.more.get(key) for key in _OF_SOURCE))]
        return [path for path in (self.scene, self.vehicle, self.cockpit, *map(self.more.get, _OF_RIG), *of_sources) if path]

    def design(self, name: str) -> Design:
        """The design of that name; BadInput names those there are."""
        for design in self.designs:
            if design.name == name:
                return design
        raise BadInput(f"no design {name}: the rig has {', '.join(design.name for design in self.designs)}")

    def document(self) -> dict[str, Any]:
        """The tables of the rig file."""
        designs = [
            _table(d, lamps=None)
            | {"lamp": [_table(lp, sources=None) | {"source": [_table(s) for s in lp.sources]} for lp in d.lamps]}
            for d in self.designs
        ]
        channels = [_table(channel) for channel in self.channels]
        return _table(self, designs=None, channels=None) | {"channel": channels or None, "design": designs}

    def write(self, file: PathLike) -> Path:
        """Writes the rig file (an existing one is replaced, whole) and returns where it lies."""
        there = Path(file)
        beside = there.with_name(there.name + ".part")
        text = toml_out.dumps(self.document())
        with told(there):
            beside.write_text(text)
            beside.replace(there)
        return there

    def problems(self) -> list[str]:
        """All that `phare rig check` finds wrong with the rig and the files it names; empty: it can be driven."""
        with tempfile.TemporaryDirectory() as folder:
            answer = run_json(["rig", "check", self.write(Path(folder) / "rig.toml")], fine=(0, 2))
        return [_text_of(problem).replace(f"{folder}/", "") for problem in answer["problems"]]

    @property
    def frame_rate_hz(self) -> int:
        """Frames of lockstep a second of simulated time."""
        return int(self.more.get("clock", {}).get("frame_rate_hz", 60))


def rig_of(rig: Rig | PathLike) -> Rig:
    """A rig, or what is read from its file."""
    return rig if isinstance(rig, Rig) else Rig.read(rig)


@contextlib.contextmanager
def file_of(rig: Rig | PathLike) -> Iterator[Path]:
    """A rig's file; of an object one that lies there for so long."""
    if not isinstance(rig, Rig):
        yield Path(rig)
        return
    with tempfile.TemporaryDirectory(prefix="phare-rig-") as folder:
        yield rig.write(Path(folder) / "rig.toml")


def _text_of(problem: Any) -> str:
    if isinstance(problem, Mapping):
        return ": ".join(str(problem[key]) for key in ("place", "text", "reason") if problem.get(key))
    return str(problem)


def _of_programs(parts: Sequence[str], what: str) -> Path:
    home = program().parent
    for folder in parts:
        there = (home / folder).resolve()
        if there.is_dir():
            return there
    raise BadInput(f"{what} of {home} is not there")


def shipped_file(name: str) -> Path:
    """A file that comes with Phare, by its path under config/: "rigs/matrix.toml", "examples/low_beam.ies"."""
    return _of_programs(["../share/phare/config", "../../../config"], "the folder of rigs and lamps") / name


def generated_file(name: str) -> Path:
    """A lamp or scene that the build made: "scenes/country_road_lane.csv"."""
    named = os.environ.get("PHARE_GENERATED_DIR")
    if named:
        return Path(named) / name
    return _of_programs(["../share/phare/generated", "../generated"], "the folder of generated files") / name


def resolved(path: str) -> Path:
    """A path of a rig: "generated/…" where the build put it, others as they are."""
    return generated_file(path.removeprefix("generated/")) if path.startswith("generated/") else Path(path)
