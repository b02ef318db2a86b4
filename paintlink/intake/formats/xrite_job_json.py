"""X-Rite job data: JSON with spectra as base64 of little-endian 32-bit floats.

The same document comes as a file and as the answer of the vendor's bridge program.
Factors are fractions. A measurement holds the values in one or several data modes,
which give different numbers for the same panel: one mode is taken, never a mixture.
"""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Iterator
from datetime import datetime

import numpy as np

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, Values, assemble
from paintlink.intake.conditions import Conditions, read_conditions
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.geometries import read_geometry
from paintlink.intake.json_tree import Node, tree_of
from paintlink.intake.source import Source
from paintlink.intake.text import plain
from paintlink.intake.times import from_seconds
from paintlink.model import Geometry, Instrument, Measurement, Reading, Texture

INFO = ImporterInfo("xrite_job_json", "X-Rite job data (JSON)")

MAX_BANDS = 1000
NATIVE_MODES = {"MA-3/5": "ma3_5", "MA-TX": "mat"}
_MILLISECONDS = 1e11


def sniff(source: Source) -> Certainty:
    """Sure of JSON with a set of measurements; other JSON gets its message here."""
    if not source.head.startswith(("{", "[")):
        return Certainty.NO
    known = b'"measurementSet"' in source.data or '"measurementSet"' in source.text
    return Certainty.SURE if known else Certainty.MAYBE


def read(source: Source, options: Options) -> Contents:
    """One reading for each measurement of each job in the document."""
    file = _File(options)
    for job in _jobs(tree_of(source)):
        file.read_job(job)
    return Contents(tuple(file.colours), notes=tuple(file.notes))


def _jobs(tree: Node) -> Iterator[Node]:
    """The jobs of a file, of a list, or of an answer of the bridge program."""
    for node in tree.items() if isinstance(tree.value, list) else [tree]:
        if node.get("success").value is False:
            message = plain(
                node.get("errorMessage").text() or node.get("errorCode").text()
            )
            msg = f"the instrument reported a failure ({message}): measure again"
            raise node.fault(msg)
        job = node if node.get("measurement").value is None else node.get("measurement")
        if job.get("measurementSet").value is None:
            raise job.fault("no measurementSet in it: export a job of readings")
        yield job


class _File:
    """What is collected over the jobs of one document."""

    def __init__(self, options: Options) -> None:
        self.colours: list[Colour] = []
        self.notes: dict[str, None] = {}
        self._options = options

    def read_job(self, job: Node) -> None:
        """Collect the readings of a job."""
        device = job.get("device")
        instrument = _instrument(device) if device.value is not None else None
        measured = job.get("measurementSet")
        name = plain(measured.get("name").text() or measured.get("id").text())
        measurements = list(measured.get("measurements").items())
        for number, node in enumerate(measurements, start=1):
            sample = f"{name} {number}" if len(measurements) > 1 else name
            mode = self._mode(node.get("colorValues"), device)
            values = self._values(node.get("colorValues").get(mode), sample)
            reading = Reading(
                Measurement(
                    values.geometries,
                    values.spectra,
                    values.lab,
                    texture=tuple(_textures(node)),
                    data_mode=plain(mode),
                    raw=json.dumps(node.value, sort_keys=True).encode(),
                    record=_record(measured, node),
                ),
                instrument or Instrument("X-Rite", "unknown"),
                self._time(node, measured),
                "real",
                sample=sample,
            )
            self.colours.append(Colour(reading))

    def _mode(self, values: Node, device: Node) -> str:
        modes = [mode for mode in values.keys() if values.get(mode).value]  # noqa: SIM118
        if not modes:
            raise values.fault("no colour values in any data mode: export again")
        wanted = self._options.data_mode
        if wanted and wanted not in modes:
            msg = f"no values in data mode {wanted!r}; there are {', '.join(modes)}"
            raise values.fault(msg)
        if len(modes) == 1:
            return modes[0]
        kind = device.get("type").text() if device.value is not None else ""
        native = NATIVE_MODES.get(kind.upper(), "")
        chosen = wanted or (native if native in modes else min(modes))
        others = ", ".join(mode for mode in modes if mode != chosen)
        note = f"data mode {chosen} taken; the file also has {others}: --data-mode"
        self.notes[note] = None
        return chosen

    def _values(self, nodes: Node, sample: str) -> Values:
        rows, scales = [], set()
        conditions: Conditions | None = None
        for node in nodes.items():
            geometry = _geometry(node)
            factors, scale = _spectrum(node.get("spectral"))
            lab, told = self._lab(node.get("lab"))
            conditions = _same(node, conditions, told)
            scales |= {scale} if factors else set()
            rows.append(Row(node.path, geometry, lab, factors))
        if len(scales) > 1:
            raise nodes.fault("spectra are on different wavelengths: export again")
        values = assemble(
            nodes.source,
            rows,
            Scales(
                wavelengths_nm=scales.pop() if scales else (),
                scale=self._options.scale or "fraction",
                conditions=conditions,
            ),
        )
        if values.spectra is None and values.lab is None:
            raise nodes.fault("neither spectra nor Lab in it: export again")
        self.notes |= {f"{sample}: {note}": None for note in values.notes}
        return values

    def _lab(self, node: Node) -> tuple[list[float] | None, Conditions | None]:
        if node.value is None:
            return None, None
        light, eye = node.get("illuminant").text(), node.get("observer").text()
        try:
            conditions = read_conditions(light, eye)
        except InputError as error:
            self.notes[f"Lab left out: {error}"] = None
            return None, None
        return [node.get(axis).number() for axis in "lab"], conditions

    def _time(self, node: Node, measured: Node) -> datetime:
        for stamp in (node.get("timestamp"), measured.get("creationTimestamp")):
            if stamp.value is not None:
                seconds = stamp.number()
                seconds /= 1000.0 if seconds > _MILLISECONDS else 1.0
                try:
                    return from_seconds(seconds)
                except InputError as error:
                    raise stamp.fault(str(error), stamp.value) from error
        self.notes[NO_TIME] = None
        return self._options.received_at


def _instrument(device: Node) -> Instrument:
    model, serial, firmware = (
        plain(device.get(key).text(), 60)
        for key in ("model", "serialNumber", "firmwareVersion")
    )
    kind = plain(device.get("type").text(), 60)
    return Instrument("X-Rite", model or kind or "unknown", serial, firmware)


def _record(measured: Node, node: Node) -> str:
    """What the instrument itself calls the reading; empty when it does not."""
    names = [measured.get("id").text(), node.get("id").text()]
    return plain("/".join(names)) if all(names) else ""


def _geometry(node: Node) -> Geometry:
    code = node.get("geometry")
    try:
        return read_geometry(code.text())
    except InputError as error:
        raise code.fault(str(error)) from error


def _spectrum(node: Node) -> tuple[list[float] | None, tuple[float, ...]]:
    """Factors and their wavelengths; None where there is no spectrum."""
    if node.value is None:
        return None, ()
    factors = _factors(node.get("values"))
    start, step = (
        node.get(key).number() for key in ("wavelengthStart", "wavelengthInterval")
    )
    if not 200.0 <= start <= 1000.0 or not 0.5 <= step <= 100.0:
        raise node.fault("no wavelength scale in nanometres: export again")
    return factors, tuple(start + step * band for band in range(len(factors)))


def _factors(node: Node) -> list[float]:
    if isinstance(node.value, list):
        factors = [one.number() for one in node.items()]
    else:
        factors = _decoded(node)
    if not 2 <= len(factors) <= MAX_BANDS:
        raise node.fault(f"{len(factors)} values are no spectrum: export again")
    return factors


def _decoded(node: Node) -> list[float]:
    try:
        data = base64.b64decode(node.text(), validate=True)
        values = np.frombuffer(data, "<f4").astype(np.float64)
    except (binascii.Error, ValueError) as error:
        msg = "no base64 of 32-bit numbers: damaged or cut, export again"
        raise node.fault(msg) from error
    if not np.isfinite(values).all():
        band = int(np.argmin(np.isfinite(values)))
        raise node.fault(f"value {band + 1} is no number: measure or export again")
    return [float(value) for value in values]


def _same(
    node: Node, before: Conditions | None, now: Conditions | None
) -> Conditions | None:
    if before is not None and now is not None and before != now:
        msg = f"Lab is for {before} and for {now} in one reading: export one of them"
        raise node.fault(msg)
    return now or before


def _textures(node: Node) -> Iterator[Texture]:
    for image in node.get("imageValues").items():
        geometry = plain(image.get("geometry").text(), 30)
        for value in image.get("textureValues").items():
            name = plain(f"{value.get('name').text()} {geometry}", 60)
            yield Texture(name, value.get("value").number())
