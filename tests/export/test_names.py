from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.export import safe_name
from paintlink.export.names import pattern_problem

RESERVED = {"CON", "PRN", "AUX", "NUL"} | {
    f"{device}{digit}" for device in ("COM", "LPT") for digit in "0123456789¹²³"
}
FORBIDDEN = set('/\\:*?"<>|\u202e\u200b') | {chr(code) for code in range(32)}

HOSTILE = [
    "", ".", "..", "...", "../../etc/passwd", "..\\..\\boot.ini", "/etc/passwd",
    "C:\\con", "CON", "con.txt", "PRN", "AUX.xml", "NUL", "COM1", "COM¹", "LPT9.a.b",
    "-rf", "--help", " lead", "trail ", "trail.", ".hidden", "~", "a\0b", "a\nb",
    "a\r\nb", "\t", "a:b", "a?b*", "<x>", "|", '"', "%2e%2e%2f", "$(reboot)", "`id`",
    "\u202egnp.exe", "\u200b", "é", "e\u0301", "ß", "ẞ", "ﬁ", "Å", "Å", "青", "🎨",
    "a" * 5000, "é" * 200, "🎨" * 100, "SIM-", "_", "__", "-_-_", "x.xml", "\ud800",
]  # fmt: skip


def many_hostile_texts() -> list[str]:
    return HOSTILE + [f"{one}{two}" for one in HOSTILE for two in HOSTILE][:500]


def is_legal_on_windows(name: str) -> bool:
    return (
        not FORBIDDEN & set(name)
        and name[0] not in ".- "
        and name[-1] not in ". "
        and name.split(".")[0].upper() not in RESERVED
        and len(name.encode()) <= 120
    )


def folded(name: str) -> str:
    """What a case-blind file system with its own normalisation keeps of a name."""
    return unicodedata.normalize("NFC", name).casefold()


def test_hostile_names_become_legal_and_stay_apart() -> None:
    texts = many_hostile_texts()

    names = [
        safe_name(text, suffix="xml", key=str(number))
        for number, text in enumerate(texts)
    ]

    assert len(texts) >= 500
    assert [name for name in names if not is_legal_on_windows(name)] == []
    assert len({folded(name) for name in names}) == len(texts)


@settings(max_examples=300)
@given(text=st.text(max_size=300), key=st.text(max_size=40))
def test_any_text_gives_a_plain_ascii_name(text: str, key: str) -> None:
    name = safe_name(text, suffix="json", key=key)

    assert is_legal_on_windows(name)
    assert name.isascii()
    assert name.count(".") == 1
    assert name.endswith(".json")


@given(first=st.text(max_size=9), second=st.text(max_size=9))
def test_equal_texts_of_different_jobs_stay_apart(first: str, second: str) -> None:
    names = {safe_name("Blue", suffix="xml", key=key) for key in (first, second)}

    assert len(names) == len({first, second})


@pytest.mark.parametrize(
    ("text", "label"),
    [
        ("Grün métallisé", "Grun_metallise"),
        ("RAL 9006.1 / basecoat", "RAL_9006_1_basecoat"),
        ("--20250314__", "20250314"),
        ("20250314__BM304", "20250314_BM304"),
    ],
)
def test_label_stays_readable(text: str, label: str) -> None:
    assert safe_name(text, suffix="xml", key="job").startswith(f"{label}-")


def test_known_fields_make_a_good_pattern() -> None:
    assert (
        pattern_problem("{date}{time}_{name}_{code}{paint}{format}{copy}{id6}") is None
    )


@pytest.mark.parametrize(
    "pattern", ["{secret}", "{name.__class__}", "{name!r}", "{date:%Y}", "{}", "{0}"]
)
def test_pattern_takes_nothing_but_fields(pattern: str) -> None:
    assert "no field" in str(pattern_problem(pattern))
    assert "{date}, {time}, {name}" in str(pattern_problem(pattern))


def test_unclosed_field_is_explained() -> None:
    assert "'{name': expected '}'" in str(pattern_problem("{name"))
