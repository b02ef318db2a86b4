from __future__ import annotations

import dataclasses
import hashlib
import math
import re
from datetime import UTC, datetime, timedelta, timezone

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from paintlink.errors import SpecError
from paintlink.model import (
    ColorSpec,
    Instrument,
    Lab,
    Provenance,
    Sample,
    Spectrum,
    StartingPaint,
    Texture,
)
from paintlink.spec import read_spec, spec_id, write_spec
from tests.spec.corpus import COMPLETE
from tests.spec.strategies import color_specs, is_carried

SAMPLES = tuple(Sample(angle, Lab(50, 0, 0)) for angle in (15, 45, 110))
PLAIN = ColorSpec("Quartz", SAMPLES)
TAKEN = datetime(2025, 3, 14, 9, 26, 53, 589793, tzinfo=UTC)


def measured(**changes: object) -> ColorSpec:
    instrument = Instrument("Example Optics", "MA-6")
    provenance = Provenance(instrument, TAKEN, "real")
    return dataclasses.replace(
        PLAIN, provenance=dataclasses.replace(provenance, **changes)
    )


def test_complete_value_becomes_the_golden_bytes() -> None:
    spec = read_spec(COMPLETE.encode())

    data = write_spec(spec)

    assert data.decode() == COMPLETE


def test_id_is_the_hash_of_the_bytes() -> None:
    expected = hashlib.sha256(COMPLETE.encode()).hexdigest()

    assert spec_id(read_spec(COMPLETE.encode())) == expected


def test_order_of_samples_leaves_no_trace() -> None:
    reversed_spec = ColorSpec("Quartz", SAMPLES[::-1])

    assert write_spec(reversed_spec) == write_spec(PLAIN)


def test_time_zone_leaves_no_trace() -> None:
    zone = timezone(timedelta(hours=5, minutes=30))
    elsewhere = measured(taken_at=TAKEN.astimezone(zone))

    assert write_spec(elsewhere) == write_spec(measured())


@pytest.mark.parametrize(
    ("taken_at", "text"),
    [
        (TAKEN, "2025-03-14T09:26:53.589793Z"),
        (TAKEN.replace(microsecond=1), "2025-03-14T09:26:53.000001Z"),
        (TAKEN.replace(microsecond=0), "2025-03-14T09:26:53Z"),
        (TAKEN.replace(year=987), "0987-03-14T09:26:53.589793Z"),
    ],
)
def test_time_is_written_to_the_microsecond(taken_at: datetime, text: str) -> None:
    data = write_spec(measured(taken_at=taken_at))

    assert f"<time>{text}</time>" in data.decode()


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (0.1 + 0.2, "0.30000000000000004"),
        (1e-7, "0.0000001"),
        (1e22, "10000000000000000000000"),
        (5e-324, "0." + "0" * 323 + "5"),
        (100.0, "100"),
        (-0.0, "0"),
    ],
)
def test_number_is_shortest_plain_decimal(number: float, text: str) -> None:
    spec = dataclasses.replace(PLAIN, texture=(Texture("sparkle", number),))

    data = write_spec(spec)

    assert f' value="{text}"/>' in data.decode()


@settings(max_examples=50, deadline=None)
@given(color_specs())
def test_no_number_has_exponent_or_negative_zero(spec: ColorSpec) -> None:
    root = etree.fromstring(write_spec(spec))

    numbers = root.xpath("//@*[not(name() = 'illuminant' or name() = 'name')]")

    assert len(numbers) > 12
    for number in numbers:
        assert re.fullmatch(r"-?\d+(\.\d*[1-9])?", number)
        assert number != "-0"


@settings(max_examples=300, deadline=None)
@given(st.text(st.characters(exclude_categories=[]), max_size=20))
def test_text_round_trips_or_is_refused(text: str) -> None:
    paint = StartingPaint(text, text, text, text, 0.0, ())
    spec = ColorSpec(
        text,
        SAMPLES,
        code=text,
        texture=(Texture(text, 1.0),),
        provenance=Provenance(
            Instrument(text, text, text, text), TAKEN, "real", data_mode=text
        ),
        starting_paint=paint,
    )

    if all(map(is_carried, text)):
        assert read_spec(write_spec(spec)) == spec
    else:
        with pytest.raises(SpecError, match=r"the character U\+[0-9A-F]{4,6} cannot"):
            write_spec(spec)


def test_every_character_of_xml_round_trips() -> None:
    carried = [chr(code) for code in range(0x110000) if is_carried(chr(code))]
    for start in range(0, len(carried), 500 * 90):
        chunk = carried[start : start + 500 * 90]
        texts = ["".join(chunk[at : at + 500]) for at in range(0, len(chunk), 500)]
        spec = dataclasses.replace(
            PLAIN, texture=tuple(Texture(text, 0.0) for text in texts)
        )

        assert read_spec(write_spec(spec)) == spec


@pytest.mark.parametrize(
    "text",
    [" ", "  Quartz  ", "a\tb", "a\nb", "a\r\nb", "\r", "\n", "\u2028", "]]>", "&amp;"],
    ids=repr,
)
def test_white_space_and_markup_round_trip(text: str) -> None:
    spec = dataclasses.replace(PLAIN, name=text, texture=(Texture(text, 1.0),))

    assert read_spec(write_spec(spec)) == spec


@pytest.mark.parametrize(
    ("character", "code"),
    [
        ("\0", r"U\+0000"),
        ("\x07", r"U\+0007"),
        ("\x1b", r"U\+001B"),
        ("\x7f", r"U\+007F"),
        ("\x9b", r"U\+009B"),
        ("\ud800", r"U\+D800"),
        ("\ufffe", r"U\+FFFE"),
        ("\uffff", r"U\+FFFF"),
    ],
)
def test_refused_character_is_named_with_its_field(character: str, code: str) -> None:
    spec = measured(instrument=Instrument("Example", "MA-6", serial=f"12{character}4"))

    with pytest.raises(SpecError, match=f"^<serial>: the character {code} cannot"):
        write_spec(spec)


def test_refused_text_is_quoted_in_part() -> None:
    spec = dataclasses.replace(PLAIN, name="x" * 10_000 + "\0")

    with pytest.raises(SpecError, match=r"U\+0000 cannot .*x…'\)$") as caught:
        write_spec(spec)

    assert len(str(caught.value)) < 200


def test_text_of_500_characters_is_the_longest() -> None:
    longest = dataclasses.replace(PLAIN, name="\U0001f600" * 500)
    too_long = dataclasses.replace(PLAIN, name="x" * 501)

    assert read_spec(write_spec(longest)) == longest
    with pytest.raises(SpecError, match=r"^<name>: name must hold at most 500 charac"):
        write_spec(too_long)


def test_spectrum_in_percent_is_refused() -> None:
    percent = Spectrum(15, 400, 10, (31.2, 30.9))

    with pytest.raises(SpecError, match=r"^<factor>: .*divide percentages by 100"):
        write_spec(dataclasses.replace(PLAIN, spectra=(percent,)))


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_number_that_is_none_is_refused(value: float) -> None:
    spec = dataclasses.replace(PLAIN, texture=(Texture("sparkle", value),))

    with pytest.raises(SpecError, match=r"^<texture>: value must be a plain decimal"):
        write_spec(spec)


def test_time_outside_the_calendar_is_refused() -> None:
    zone = timezone(timedelta(hours=14))
    spec = measured(taken_at=datetime.min.replace(tzinfo=zone))

    with pytest.raises(SpecError, match=r"^<time>: .* correct the clock"):
        write_spec(spec)


def test_what_could_not_be_read_is_not_written() -> None:
    factors = tuple(5e-324 * count for count in range(1, 501))
    spectra = tuple(Spectrum(angle, 400, 1, factors) for angle in range(12))

    with pytest.raises(SpecError, match="larger than 1048576 bytes"):
        write_spec(dataclasses.replace(PLAIN, spectra=spectra))


def test_most_that_the_schema_allows_is_written() -> None:
    spectra = tuple(
        Spectrum(angle, 400, 1, tuple(count / 499 for count in range(500)))
        for angle in range(12)
    )
    textures = tuple(Texture(f"texture {count}", 1.0, 15) for count in range(100))
    spec = dataclasses.replace(PLAIN, spectra=spectra, texture=textures)

    assert read_spec(write_spec(spec)) == spec
