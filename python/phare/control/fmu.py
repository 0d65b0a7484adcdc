"""A law that is an FMI 3.0 co-simulation unit (an FMU), run by FMPy (docs/fmu-law.md)."""

from __future__ import annotations

import math
import os
import sys
import tempfile
import warnings
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ..errors import BadInput, LawFailed
from . import fmu_names as names
from .controller import Controller
from .messages import LIGHT, Answer, Given, LampOfLaw

_FLOATS = ("Float64", "Float32")
_WHOLES = ("Int32", "UInt32", "Int64", "UInt64", "Enumeration")
_TYPES = {names.REAL: _FLOATS, names.WHOLE: (*_WHOLES, *_FLOATS), names.YES_NO: ("Boolean", *_WHOLES, *_FLOATS)}


@dataclass(frozen=True)
class _Variable:
    """One of the unit that has a meaning here."""

    name: str
    reference: int
    type: str
    size: int  # elements; 1 for what is no array
    is_array: bool
    meaning: names.Meaning

    @property
    def call(self) -> str:
        """As FMPy's getters and setters end."""
        return "Int64" if self.type == "Enumeration" else self.type

    @property
    def reaches(self) -> int:
        """The number of the last element it has."""
        return self.size if self.is_array else self.meaning.element


class Fmu(Controller):
    """Asks a unit: in the first frame for its outputs after initialisation, then after a step as long as the frame.

    The unit begins anew with every drive, every design and where time goes back. It runs in this process: one that crashes takes the process
    with it, so for one that is not trusted give `phare.Program(["python3", "-m", "phare.laws.fmu", file])`.
    """

    def __init__(self, file: str | os.PathLike[str]):
        """Raises BadInput where the file is no FMI 3.0 co-simulation unit for this machine, or none of its outputs is known here."""
        self.file = Path(file).absolute()
        self._fmpy = _fmpy()
        self._described = self._read()
        self.inputs: list[_Variable] = []
        self.outputs: list[_Variable] = []
        self.unknown: list[str] = []  # inputs and outputs that mean nothing here
        for variable in self._described.modelVariables:
            if variable.causality in ("input", "output"):
                self._sort(variable)
        if not self.outputs:
            raise self._bad("has no output that is known here: light, levelling_rad, lamps.…, sources.dimming_01 (docs/fmu-law.md)")
        self._count = {
            group: max((v.reaches for v in self.inputs if v.meaning.group == group and v.meaning.name != "count"), default=0)
            for group in names.GROUPS
        }
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._unit: Any = None
        self._started = False
        self._time_s = self._step_s = 0.0

    # ---- what it is

    def _bad(self, why: str) -> BadInput:
        return BadInput(f"{self.file}: {why}")

    def _read(self) -> Any:
        if not self.file.is_file():
            raise self._bad("no such file")
        try:
            version = self._version()
            if not version.startswith("3."):
                raise self._bad(f"is of FMI {version}: expected 3.0")
            described = self._fmpy.read_model_description(str(self.file))
            platforms = self._fmpy.supported_platforms(str(self.file))
        except BadInput:
            raise
        except Exception as wrong:  # of zipfile, lxml and FMPy, each with words of its own
            raise self._bad(f"cannot be read as an FMU: {' '.join(str(wrong).split())}") from wrong
        if described.coSimulation is None:
            raise self._bad("has no co-simulation: a unit of model exchange or scheduled execution alone cannot be a law")
        if self._fmpy.platform not in platforms:
            raise self._bad(f"has no binary for this machine, binaries/{self._fmpy.platform_tuple}; it has {', '.join(platforms) or 'none'}")
        return described

    def _version(self) -> str:
        """Of FMI, as the first element of its description says."""
        with zipfile.ZipFile(self.file) as whole, whole.open("modelDescription.xml") as text:
            return str(next(ElementTree.iterparse(text, ["start"]))[1].get("fmiVersion"))

    def _sort(self, variable: Any) -> None:
        ours = names.input_named(variable.name) if variable.causality == "input" else names.output_named(variable.name)
        if ours is None:
            self.unknown.append(f"{variable.causality} {variable.name}")
            return
        place = f"{variable.causality} {variable.name}"
        if variable.type not in _TYPES[ours.kind]:
            raise self._bad(f"{place} is {variable.type}: expected {' or '.join(_TYPES[ours.kind])}")
        shape = tuple(variable.shape or ())
        whole = bool(ours.group) and not ours.element and ours.name != "count"
        if len(shape) != int(whole):
            expected = "an array of one dimension" if whole else "no array"
            raise self._bad(f"{place} has {len(shape)} dimensions: expected {expected}")
        known = _Variable(variable.name, variable.valueReference, variable.type, math.prod(shape), whole, ours)
        (self.inputs if variable.causality == "input" else self.outputs).append(known)

    # ---- its life

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self.end()
        if self.unknown:
            warnings.warn(f"{self.file}: not known here, inputs keep their start values: {', '.join(self.unknown)}", stacklevel=2)
        self._folder, here = tempfile.TemporaryDirectory(prefix="phare-fmu-"), os.getcwd()
        try:
            self._fmpy.extract(str(self.file), self._folder.name)
            self._unit = self._fmpy.fmi3.FMU3Slave(
                instanceName="phare", guid=self._described.guid, unzipDirectory=self._folder.name,
                modelIdentifier=self._described.coSimulation.modelIdentifier,
            )
            self._unit.instantiate(logMessage=_say)
        except Exception as wrong:
            os.chdir(here)  # FMPy goes to the library's folder to load it, and stays there where that fails
            if self._unit is not None:  # loaded, but no instance
                self._unit.freeLibrary()
            self._unit = None
            self.end()
            raise LawFailed(f"{self.file}: {wrong}") from wrong

    def step(self, given: Given) -> Answer:
        if self._started and given.time_s < self._time_s - 1e-6:
            self.begin(given.lamps)
        try:
            self._advance(given)
            answer = self._answer(given.lamps)
            answer.to_proto(given.lamps)  # says what is out of range
            return answer
        except LawFailed as wrong:
            raise LawFailed(f"{self.file}: at {given.time_s:.6g} s: {wrong}") from wrong.__cause__
        except self._fmpy.fmi1.FMICallException as wrong:
            raise LawFailed(f"{self.file}: at {given.time_s:.6g} s: {wrong}") from wrong

    def end(self) -> None:
        unit, self._unit, started, self._started = self._unit, None, self._started, False
        if unit is not None:
            try:
                if started:
                    unit.terminate()
            except self._fmpy.fmi1.FMICallException:
                pass  # it has failed before, and that is told
            unit.freeInstance()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _advance(self, given: Given) -> None:
        """Its outputs belong to the time of `given` afterwards."""
        if not self._started:
            self._unit.enterInitializationMode(startTime=given.time_s)
            self._give(given)
            self._unit.exitInitializationMode()
            self._started, self._time_s, self._step_s = True, given.time_s, 0.0
            return
        step_s = given.time_s - self._time_s
        if step_s <= 1e-6:
            return  # the same frame is asked for again
        if abs(step_s - given.step_s) < 1e-6:
            step_s = given.step_s  # to the last bit what a law of Python is given
        if not self._described.coSimulation.canHandleVariableCommunicationStepSize:
            self._step_s = self._step_s or step_s
            if abs(step_s - self._step_s) > 0.01 * self._step_s:
                raise LawFailed(f"a step of {step_s:.6g} s after those of {self._step_s:.6g} s: the unit takes steps of one length only")
            step_s = self._step_s
        self._give(given)
        _, ended, _, _ = self._unit.doStep(self._time_s, step_s)
        if ended:
            raise LawFailed("the unit asked for the end of the simulation")
        self._time_s += step_s

    def _give(self, given: Given) -> None:
        items = names.items_of(given)
        for variable in self.inputs:
            self._set(variable, self._values(variable, given, items))

    def _values(self, variable: _Variable, given: Given, items: dict[str, list[Any]]) -> list[float]:
        group, name = variable.meaning.group, variable.meaning.name
        if not group:
            return [names.SCALARS[name][1](given)]
        if name == "count":
            return [min(len(items[group]), self._count[group]) if self._count[group] else len(items[group])]
        value = names.GROUPS[group][name][1]
        first = max(variable.meaning.element, 1) - 1
        values = [value(item) for item in items[group][first : first + variable.size]]
        return values + [0.0] * (variable.size - len(values))

    def _set(self, variable: _Variable, values: list[float]) -> None:
        turned = bool if variable.type == "Boolean" else float if variable.type in _FLOATS else int
        getattr(self._unit, f"set{variable.call}")([variable.reference], [turned(value) for value in values])

    def _get(self, variable: _Variable) -> list[float]:
        values = getattr(self._unit, f"get{variable.call}")([variable.reference], nValues=variable.size)
        for value in values:
            if not math.isfinite(value):
                raise LawFailed(f"output {variable.name} is {value}")
        return list(values)

    def _answer(self, lamps: list[LampOfLaw]) -> Answer:
        light, levelling_rad = 0.0, 0.0
        groups: dict[tuple[str, str], list[float]] = {}
        for variable in self.outputs:
            values, meaning = self._get(variable), variable.meaning
            if meaning.name == "light":
                light = values[0]
                if light not in range(len(LIGHT)):
                    raise LawFailed(f"output light is {light:g}: 0 as the stalk says, 1 position, 2 low, 3 high")
            elif not meaning.group:
                levelling_rad = values[0]
            else:
                _put(groups.setdefault((meaning.group, meaning.name), []), variable, values)
        return names.answer_of(int(light), levelling_rad, groups, lamps)


def _put(into: list[float], variable: _Variable, values: list[float]) -> None:
    """Elements that a unit lacks in between are as if it had none: full light, straight."""
    otherwise = 1.0 if variable.meaning.name == "dimming_01" else 0.0
    first = max(variable.meaning.element, 1) - 1
    into.extend([otherwise] * (first + len(values) - len(into)))
    into[first : first + len(values)] = values


def _say(_environment: Any, status: int, _category: bytes, message: bytes) -> None:
    """What a unit logs goes to standard error; standard output may be the way of its answers."""
    print(f"fmu: {message.decode('utf-8', 'replace')}", file=sys.stderr)


def _fmpy() -> Any:
    try:
        import fmpy
        import fmpy.fmi1
        import fmpy.fmi3
    except ImportError as wrong:
        raise BadInput(f"an FMU is run by FMPy, which is not here ({wrong}): pip install 'FMPy>=0.3.22', or ./python[fmi]") from wrong
    return fmpy
