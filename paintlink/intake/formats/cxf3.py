"""Color Exchange Format 3 (ISO 17972-1) with multi-angle geometry.

Each value points to a colour specification, which says at which angle and for which
illuminant it was measured. Reflectance is a fraction, as the standard has it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from typing import cast

from lxml import etree

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, assemble
from paintlink.intake.conditions import SPECIFICATION, Conditions
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.formats._cxf3_specs import (
    CORE,
    ColorSpecs,
    MeasuredAs,
    gloss_of,
    numbers_of,
    path,
    text_of,
)
from paintlink.intake.source import Source
from paintlink.intake.text import plain
from paintlink.intake.times import parse_time
from paintlink.intake.xml import line_of, root_of
from paintlink.model import FINISHES, Finish, Geometry, Measurement, Origin, Reading

INFO = ImporterInfo("cxf3", "Color Exchange Format 3 (CxF, ISO 17972-1)")

OWN_TAGS = "paintlink"
LONGEST_SPECTRUM = 40_000


def sniff(source: Source) -> Certainty:
    """Sure of the namespace in the first lines."""
    known = "colorexchangeformat.com/CxF" in source.head or "<CxF" in source.head
    return Certainty.SURE if known else Certainty.NO


def read(source: Source, options: Options) -> Contents:
    """One reading for each object with reflectance or Lab values."""
    root = root_of(source)
    name = etree.QName(root)
    if (name.namespace, name.localname) != (CORE, "CxF"):
        msg = f'not CxF version 3: expected <CxF xmlns="{CORE}">; export as CxF3'
        raise source.fault(line_of(root), msg, name.namespace or name.localname)
    file = _File(source, options, ColorSpecs(source, root, options))
    nodes = root.findall(path("Resources/ObjectCollection/Object"))
    colours = [one for one in map(file.colour, nodes) if one is not None]
    left_out = len(nodes) - len(colours)
    if left_out:
        file.notes[f"{left_out} objects without reflectance or Lab left out"] = None
    return Contents(tuple(colours), notes=(*file.specs.notes, *file.notes))


@dataclass(frozen=True, slots=True)
class _Value:
    """Numbers of one value element and how they were measured."""

    node: etree._Element
    measured: MeasuredAs
    numbers: list[float]

    @property
    def geometry(self) -> Geometry | None:
        """The geometry of the value; None when its specification has several."""
        several = self.measured.geometries
        if len(several) == 1:
            return several[0]
        named = [one for one in several if one.code == self.node.get("Name")]
        return named[0] if len(named) == 1 else None


class _File:
    """What the objects of one file share."""

    def __init__(self, source: Source, options: Options, specs: ColorSpecs) -> None:
        self.specs = specs
        self.notes: dict[str, None] = {}
        self._source = source
        self._options = options

    def colour(self, node: etree._Element) -> Colour | None:
        """The reading of an object; None when it has no values paintlink uses."""
        spectra = list(self._spectra(node))
        labs, conditions = _one_condition(list(self._labs(node)))
        values = [*spectra, *labs]
        if not values:
            return None
        name = plain(node.get("Name") or node.get("Id") or "")
        tags = _own_tags(node)
        measured = self._measurement(node, spectra, labs, conditions, tags)
        for note in measured[1]:
            self.notes[f"{name}: {note}"] = None
        origin: Origin = "simulated" if tags.get("origin") == "simulated" else "real"
        reading = Reading(
            measured[0],
            values[0].measured.instrument,
            self._time(node),
            origin,
            sample=name,
        )
        finish = cast("Finish", tags.get("finish", "unknown"))
        return Colour(
            reading,
            finish if finish in FINISHES else "unknown",
            plain(tags.get("code", "")),
        )

    def _measurement(
        self,
        node: etree._Element,
        spectra: list[_Value],
        labs: list[_Value],
        conditions: Conditions | None,
        tags: dict[str, str],
    ) -> tuple[Measurement, tuple[str, ...]]:
        scales = Scales(
            wavelengths_nm=self._wavelengths(spectra),
            scale=self._options.scale or "fraction",
            conditions=conditions,
        )
        values = assemble(self._source, self._rows(spectra, labs), scales)
        first = (spectra or labs)[0].measured
        measurement = Measurement(
            values.geometries,
            values.spectra,
            values.lab,
            gloss=gloss_of(self._source, node) or first.gloss,
            averaged=_count(tags.get("averaged", "1")),
            data_mode=plain(tags.get("dataMode", first.data_mode)),
            raw=etree.tostring(node, method="c14n", exclusive=True),
        )
        return measurement, values.notes

    def _spectra(self, node: etree._Element) -> Iterator[_Value]:
        for one in node.iterfind(path("ColorValues/ReflectanceSpectrum")):
            text = one.text or ""
            if len(text) > LONGEST_SPECTRUM:
                msg = "far more values than a spectrum has: export again"
                raise self._source.fault(line_of(one), msg)
            texts = text.split()
            yield _Value(one, self.specs.of(one), self._numbers(one, texts))

    def _labs(self, node: etree._Element) -> Iterator[_Value]:
        for one in node.iterfind(path("ColorValues/ColorCIELab")):
            texts = [text_of(one, axis) for axis in "LAB"]
            yield _Value(one, self.specs.of(one), self._numbers(one, texts))

    def _numbers(self, node: etree._Element, texts: list[str]) -> list[float]:
        return numbers_of(self._source, line_of(node), texts)

    def _rows(self, spectra: list[_Value], labs: list[_Value]) -> list[Row]:
        """Spectrum and Lab of the same angle as one row."""
        rows: list[Row] = []
        for value in spectra:
            geometry = self._geometry(value)
            rows.append(Row(line_of(value.node), geometry, factors=value.numbers))
        for value in labs:
            geometry = self._geometry(value)
            partner = next(
                (
                    i
                    for i, row in enumerate(rows)
                    if row.lab is None and _alike(row.geometry, geometry)
                ),
                None,
            )
            if partner is None:
                rows.append(Row(line_of(value.node), geometry, lab=value.numbers))
            else:
                rows[partner] = replace(rows[partner], lab=value.numbers)
        return rows

    def _geometry(self, value: _Value) -> Geometry:
        if value.geometry is not None:
            return value.geometry
        msg = (
            "its ColorSpecification has several angles and the Name of the value is "
            "none of their notations: export one specification for each angle"
        )
        raise self._source.fault(line_of(value.node), msg, value.node.get("Name"))

    def _wavelengths(self, spectra: list[_Value]) -> tuple[float, ...]:
        found = {self._wavelengths_of(value) for value in spectra}
        if len(found) > 1:
            msg = "spectra of one object are on different wavelengths: export again"
            raise self._source.fault(line_of(spectra[0].node), msg)
        return found.pop() if found else ()

    def _wavelengths_of(self, value: _Value) -> tuple[float, ...]:
        scale = value.measured.scale_nm
        if scale is None:
            msg = "its ColorSpecification has no WavelengthRange: export again"
            raise self._source.fault(line_of(value.node), msg)
        start, step = scale
        own = value.node.get("StartWL")
        if own is not None:
            (start,) = self._numbers(value.node, [own])
        return tuple(start + step * i for i in range(len(value.numbers)))

    def _time(self, node: etree._Element) -> datetime:
        text = text_of(node, "CreationDate")
        if not text:
            self.notes[NO_TIME] = None
            return self._options.received_at
        try:
            return parse_time(text, self._options.zone)
        except InputError as error:
            where = f"{line_of(node)}, CreationDate"
            raise self._source.fault(where, str(error), text) from error


def _one_condition(labs: list[_Value]) -> tuple[list[_Value], Conditions | None]:
    """Lab for D65/10 where there is any, else for the first known conditions."""
    known = [one.measured.conditions for one in labs if one.measured.conditions]
    if not known:
        return [], None
    chosen = SPECIFICATION if SPECIFICATION in known else known[0]
    return [one for one in labs if one.measured.conditions == chosen], chosen


def _alike(one: Geometry, other: Geometry) -> bool:
    return replace(one, code="") == replace(other, code="")


def _own_tags(node: etree._Element) -> dict[str, str]:
    """What paintlink itself wrote beside the standard's own fields."""
    collections: Iterable[etree._Element] = node.iterfind(path("TagCollection"))
    return {
        tag.get("Name", ""): tag.get("Value", "")
        for collection in collections
        if collection.get("Name") == OWN_TAGS
        for tag in collection.iterfind(path("Tag"))
    }


def _count(text: str) -> int:
    return int(text) if text.isascii() and text.isdecimal() and len(text) < 4 else 1
