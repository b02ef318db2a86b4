"""Numbers and encodings as foreign programs write them."""

from __future__ import annotations

import pytest

from paintlink.errors import InputError
from paintlink.intake.text import decode, parse_number, plain


@pytest.mark.parametrize(
    ("text", "decimal", "value"),
    [
        ("12.5", ".", 12.5),
        (" -0.25 ", ".", -0.25),
        ("\u221212.5", ".", -12.5),
        ("1e-3", ".", 0.001),
        ("12,5", ",", 12.5),
        ("43.1 %", ".", 0.431),
        ("43,1%", ",", 0.431),
        (".5", ".", 0.5),
        ("7.", ".", 7.0),
    ],
)
def test_numbers_are_read(text: str, decimal: str, value: float) -> None:
    assert parse_number(text, decimal=decimal).value == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "decimal", "told"),
    [
        ("", ".", "a number is missing"),
        ("12,5", ".", "a decimal comma where the file has the other sign"),
        ("12.5", ",", "a decimal point where the file has the other sign"),
        ("1,234.5", ".", "thousands separators"),
        ("1.234,5", ",", "thousands separators"),
        ("n/a", ".", "not a number"),
        ("0x10", ".", "not a number"),
        ("1_000", ".", "not a number"),
        ("NaN", ".", "not a number"),
        ("inf", ".", "not a number"),
        ("1e999", ".", "too large"),
        ("\u0661\u0662", ".", "not a number"),
        ("9" * 500, ".", "not a number"),
    ],
)
def test_other_texts_are_told_apart(text: str, decimal: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        parse_number(text, decimal=decimal)


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"]
)
def test_encodings_are_told_by_their_bytes(encoding: str) -> None:
    text = "Name;L* 15°\nGröße;1\n"

    assert decode(text.encode(encoding)).text == text
    assert decode(text.encode(encoding)).note == ""


def test_windows_text_is_read_with_a_note() -> None:
    found = decode("Größe".encode("cp1252"))

    assert found.text == "Größe"
    assert found.note == "not UTF-8: read as Windows-1252"


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"abc\0def\xff", "damaged text"),
        (b"abc\0def", "binary data where text is expected"),
        ("abc".encode("utf-32"), "UTF-32, which no instrument writes"),
        (b"\xff\xfea\0b", r"line 1: damaged text \(UTF-16-LE\)"),
    ],
)
def test_binary_and_damaged_data_are_told(data: bytes, told: str) -> None:
    with pytest.raises(InputError, match=told):
        decode(data)


def test_names_lose_what_no_file_can_carry() -> None:
    assert plain(" a\0b\x1b[31m \n c\ud800 ") == "ab[31m c"
    assert len(plain("x" * 1000)) == 200
