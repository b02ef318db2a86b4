"""JSON documents of the values the journal stores."""

from __future__ import annotations

import json
from dataclasses import asdict
from datetime import datetime
from typing import Any

from paintlink.model import (
    AngleDifference,
    Calibration,
    Geometry,
    Gloss,
    Instrument,
    LabValues,
    Match,
    Measurement,
    Reading,
    Spectra,
    Texture,
)


def reading_to_json(reading: Reading) -> str:
    """Everything of a reading but its raw bytes; every number round-trips."""
    measured = reading.measurement
    spectra, lab = measured.spectra, measured.lab
    return json.dumps({
        "instrument": asdict(reading.instrument),
        "taken_at": reading.taken_at.isoformat(),
        "origin": reading.origin,
        "sample": reading.sample,
        "calibration": {
            "state": reading.calibration.state,
            "at": _time_text(reading.calibration.at),
        },
        "geometries": [asdict(geometry) for geometry in measured.geometries],
        "spectra": spectra
        and {
            "wavelengths_nm": spectra.wavelengths_nm.tolist(),
            "factors": spectra.factors.tolist(),
        },
        "lab": lab
        and {
            "lab": lab.lab.tolist(),
            "illuminant": lab.illuminant,
            "observer": lab.observer,
        },
        "gloss": measured.gloss and asdict(measured.gloss),
        "texture": [asdict(value) for value in measured.texture],
        "averaged": measured.averaged,
        "data_mode": measured.data_mode,
        "record": measured.record,
        "spread": measured.spread,
        "finish": reading.finish,
    })


def reading_from_json(text: str, raw: bytes) -> Reading:
    """The reading that `reading_to_json` wrote, with its raw bytes put back."""
    data: dict[str, Any] = json.loads(text)
    measurement = Measurement(
        geometries=tuple(Geometry(**item) for item in data["geometries"]),
        spectra=Spectra(**data["spectra"]) if data["spectra"] else None,
        lab=LabValues(**data["lab"]) if data["lab"] else None,
        gloss=Gloss(**data["gloss"]) if data["gloss"] else None,
        texture=tuple(Texture(**item) for item in data["texture"]),
        averaged=data["averaged"],
        data_mode=data["data_mode"],
        raw=raw,
        record=data.get("record", ""),
        spread=tuple(data.get("spread", ())),
    )
    calibration = data["calibration"]
    return Reading(
        measurement=measurement,
        instrument=Instrument(**data["instrument"]),
        taken_at=datetime.fromisoformat(data["taken_at"]),
        origin=data["origin"],
        calibration=Calibration(calibration["state"], _time(calibration["at"])),
        sample=data["sample"],
        finish=data.get("finish", "unknown"),
    )


def match_to_json(match: Match) -> str:
    """A match as one JSON object."""
    return json.dumps({name: getattr(match, name) for name in Match.__slots__})


def match_from_json(text: str) -> Match:
    """The match that `match_to_json` wrote."""
    data: dict[str, Any] = json.loads(text)
    data["differences"] = tuple(map(_difference, data["differences"]))
    data["angles_deg"] = tuple(data["angles_deg"])
    data["estimated_deg"] = tuple(data.get("estimated_deg", ()))
    return Match(**data)


def _difference(data: list[float] | dict[str, float]) -> AngleDifference:
    """One difference; journals of the first version wrote its names too."""
    return AngleDifference(**data) if isinstance(data, dict) else AngleDifference(*data)


def _time_text(moment: datetime | None) -> str | None:
    return moment.isoformat() if moment else None


def _time(text: str | None) -> datetime | None:
    return datetime.fromisoformat(text) if text else None
