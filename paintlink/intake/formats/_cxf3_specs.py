"""The part of a CxF file that says how values were measured."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from lxml import etree

from paintlink.errors import InputError
from paintlink.intake.conditions import Conditions, read_conditions
from paintlink.intake.contract import Options
from paintlink.intake.geometries import read_geometry
from paintlink.intake.source import Source
from paintlink.intake.text import parse_number, plain
from paintlink.intake.xml import line_of
from paintlink.model import ASPECULAR_RANGE_DEG, Geometry, Gloss, Instrument

CORE = "http://colorexchangeformat.com/CxF3-core"
UNKNOWN = "unknown"
SPHERE_NOTE = "sphere geometry: right for solid colours only"

_GLOSS_ANGLE = re.compile(r"(?<!\d)(20|45|60|75|85)(?!\d)")


def path(steps: str) -> str:
    """A path below an element, each step in the namespace of CxF."""
    return "/".join(f"{{{CORE}}}{step}" for step in steps.split("/"))


def text_of(node: etree._Element, steps: str) -> str:
    """Text of the first element on a path, without blanks around; empty if none."""
    return (node.findtext(path(steps)) or "").strip()


def numbers_of(source: Source, where: str, texts: Sequence[str]) -> list[float]:
    """The numbers of some texts; a fault names the place."""
    try:
        return [parse_number(text).value for text in texts]
    except InputError as error:
        wrong = next((one for one in texts if _is_faulty(one)), "")
        raise source.fault(where, str(error), wrong) from error


def _is_faulty(text: str) -> bool:
    try:
        parse_number(text)
    except InputError:
        return True
    return False


@dataclass(frozen=True, slots=True)
class MeasuredAs:
    """How a value was measured: one colour specification of the file."""

    geometries: tuple[Geometry, ...]
    scale_nm: tuple[float, float] | None
    conditions: Conditions | None
    instrument: Instrument
    data_mode: str
    gloss: Gloss | None


class ColorSpecs:
    """Colour specifications by id, each read when a value points to it."""

    def __init__(self, source: Source, root: etree._Element, options: Options) -> None:
        self.notes: dict[str, None] = {}
        self._source = source
        self._options = options
        self._found: dict[str, MeasuredAs] = {}
        nodes = root.iterfind(
            path("Resources/ColorSpecificationCollection/ColorSpecification")
        )
        self._nodes = {node.get("Id", ""): node for node in nodes}

    def of(self, value: etree._Element) -> MeasuredAs:
        """How a value was measured."""
        name = value.get("ColorSpecification", "")
        if name not in self._nodes:
            msg = "points to a ColorSpecification the file does not have: export again"
            raise self._source.fault(line_of(value), msg, name)
        if name not in self._found:
            self._found[name] = self._read(self._nodes[name])
        return self._found[name]

    def _read(self, node: etree._Element) -> MeasuredAs:
        measured = node.find(path("MeasurementSpec"))
        if measured is None:
            msg = "the ColorSpecification has no MeasurementSpec: export again"
            raise self._source.fault(line_of(node), msg)
        kind = text_of(measured, "MeasurementType")
        if kind and "Reflectance" not in kind:
            msg = "no reflectance measurement: export reflectance of the paint"
            raise self._source.fault(line_of(measured), msg, kind)
        return MeasuredAs(
            geometries=self._geometries(measured),
            scale_nm=self._scale(measured),
            conditions=self._conditions(node),
            instrument=_instrument(measured),
            data_mode=plain(text_of(measured, "CalibrationStandard")),
            gloss=gloss_of(self._source, node),
        )

    def _scale(self, measured: etree._Element) -> tuple[float, float] | None:
        node = measured.find(path("WavelengthRange"))
        if node is None:
            return None
        texts = [node.get("StartWL", ""), node.get("Increment", "")]
        start, step = numbers_of(self._source, line_of(node), texts)
        if not 200.0 <= start <= 1000.0 or not 0.5 <= step <= 100.0:
            msg = "no wavelength scale in nanometres: export again"
            raise self._source.fault(line_of(node), msg, f"{start:g} step {step:g}")
        return start, step

    def _conditions(self, node: etree._Element) -> Conditions | None:
        spec = node.find(path("TristimulusSpec"))
        if spec is None:
            return None
        light, eye = text_of(spec, "Illuminant"), text_of(spec, "Observer")
        try:
            return read_conditions(light, eye)
        except InputError as error:
            self.notes[f"Lab left out: {error}"] = None
            return None

    def _geometries(self, measured: etree._Element) -> tuple[Geometry, ...]:
        choice = measured.find(path("GeometryChoice"))
        angles = (
            choice.findall(path("MultiAngle/BRDFAngle")) if choice is not None else []
        )
        if angles:
            return tuple(self._brdf_angle(angle) for angle in angles)
        return (self._single(measured, choice),)

    def _brdf_angle(self, node: etree._Element) -> Geometry:
        texts = [
            text_of(node, name)
            for name in ("IlluminationAngle", "Aspecular", "Azimuth")
        ]
        texts[2] = texts[2] or "0"
        illumination, aspecular, azimuth = numbers_of(
            self._source, line_of(node), texts
        )
        low, high = ASPECULAR_RANGE_DEG
        if not 0.0 <= illumination < 90.0 or not low <= aspecular <= high:
            msg = f"the angles are impossible (aspecular {low:g} to {high:g})"
            raise self._source.fault(line_of(node), msg, "/".join(texts))
        code = plain(node.get("Notation", "")) or f"{illumination:g}as{aspecular:g}"
        geometry = Geometry(aspecular, illumination, azimuth, code)
        self._require_agreement(node, geometry)
        return geometry

    def _require_agreement(self, node: etree._Element, geometry: Geometry) -> None:
        try:
            told = read_geometry(geometry.code)
        except InputError:
            return  # a free text; the numbers say enough
        if replace(told, code="") != replace(geometry, code=""):
            msg = "the notation and the angles beside it disagree: correct one of them"
            raise self._source.fault(line_of(node), msg, geometry.code)

    def _single(
        self, measured: etree._Element, choice: etree._Element | None
    ) -> Geometry:
        if self._options.geometry:
            return read_geometry(self._options.geometry)
        single = None if choice is None else choice.find(path("SingleAngle"))
        if single is not None:
            angles = (
                text_of(single, "IlluminationAngle"),
                text_of(single, "MeasurementAngle"),
            )
            pair = tuple(numbers_of(self._source, line_of(single), angles))
            if pair in {(45.0, 0.0), (0.0, 45.0)}:
                return Geometry(45.0, code=f"{pair[0]:g}/{pair[1]:g}")
        sphere = "" if choice is None else text_of(choice, "SphereGeometry")
        if sphere == "Specular_Excluded":
            self.notes[SPHERE_NOTE] = None
            return Geometry(45.0, code="sphere, specular excluded")
        msg = (
            "no geometry a specification can have (multi-angle, 45/0, or specular "
            "excluded): export multi-angle values, or declare it with --geometry 45as45"
        )
        raise self._source.fault(line_of(measured), msg, sphere or None)


def gloss_of(source: Source, node: etree._Element) -> Gloss | None:
    """Gloss among the physical attributes of an element, at 60 degrees if it has it."""
    found = []
    for gloss in node.iterfind(path("PhysicalAttributes/Gloss")):
        angle = _GLOSS_ANGLE.search(gloss.get("Method", ""))
        (value,) = numbers_of(source, line_of(gloss), [(gloss.text or "").strip()])
        try:
            found.append(Gloss(value, float(angle[1]) if angle else None))
        except InputError as error:
            raise source.fault(line_of(gloss), str(error)) from error
    return min(found, key=lambda one: one.angle_deg != 60.0, default=None)


def _instrument(measured: etree._Element) -> Instrument:
    maker, model, serial = (
        plain(text_of(measured, f"Device/{name}"), 60)
        for name in ("Manufacturer", "Model", "SerialNumber")
    )
    return Instrument(maker or UNKNOWN, model or UNKNOWN, serial)
