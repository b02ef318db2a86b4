"""Documents of the right shape with values no paint can have."""

from __future__ import annotations

from tests.spec.corpus import Case, edited, wrong

PLAIN = "L must be a plain decimal number such as -12.5"
L_LIMITS = "L must lie between -16 and 170: check the units and the column order"

_NOT_NUMBERS = {
    "NaN": "NaN",
    "infinity": "INF",
    "minus infinity": "-INF",
    "infinity of Python": "inf",
    "beyond the largest double": "1e400",
    "exponent": "6.01E1",
    "decimal comma": "60,1",
    "thousands separator": "1 060.1",
    "plus sign": "+60.1",
    "Unicode minus": "−3",
    "Arabic-Indic digits": "٦٠",
    "fullwidth digits": "６０",
    "hexadecimal": "0x3C",
    "underscore of Python": "6_0",
    "no digits": "-",
    "only a point": ".",
    "empty": "",
    "word": "n/a",
    "no-break space": "60.1\N{NO-BREAK SPACE}",
}

_TOO_LONG = "9" * 400

NUMBERS = [
    wrong(name, 'L="60.1"', f'L="{value}"', PLAIN, element="sample", value=value)
    for name, value in _NOT_NUMBERS.items()
]

LIMITS = [
    wrong("L too dark", 'L="60.1"', 'L="-17"', L_LIMITS, element="sample", value="-17"),
    wrong(
        "L too light", 'L="60.1"', 'L="171"', L_LIMITS, element="sample", value="171"
    ),
    wrong(
        "L just too light",
        'L="60.1"',
        'L="170.00000000000003"',
        L_LIMITS,
        element="sample",
        value="170.00000000000003",
    ),
    wrong(
        "L of 400 digits",
        'L="60.1"',
        f'L="{_TOO_LONG}"',
        L_LIMITS,
        element="sample",
        value=_TOO_LONG[:80] + "…",
    ),
    wrong(
        "a out of range",
        'a="-1.1"',
        'a="-401"',
        "a must lie between -400 and 400",
        element="sample",
        value="-401",
    ),
    wrong(
        "b out of range",
        'b="-2.75"',
        'b="400.1"',
        "b must lie between -400 and 400",
        element="sample",
        value="400.1",
    ),
    wrong(
        "angle out of range",
        'aspecular="110"',
        'aspecular="181"',
        "aspecular must lie between -90 and 180 degrees",
        element="sample",
        value="181",
    ),
    wrong(
        "negative gloss",
        'value="92.4"',
        'value="-1"',
        "value must lie between 0 and 2000 gloss units",
        element="gloss",
        value="-1",
    ),
    wrong(
        "gloss angle 33",
        'angle="60"',
        'angle="33"',
        "angle must be one of 20, 45, 60, 75, 85 degrees, or left out",
        element="gloss",
        value="33",
    ),
    wrong(
        "spectrum in percent",
        "<factor>1.2312",
        "<factor>28.12",
        r"fractions, 1\.0 = 100 %, so divide percentages by 100",
        element="factor",
        value="28.12",
    ),
    wrong(
        "factor NaN",
        "<factor>1.2312",
        "<factor>NaN",
        "factor must be a plain decimal number",
        element="factor",
        value="NaN",
    ),
    wrong(
        "wavelengths in micrometres",
        'start="400"',
        'start="0.4"',
        "start must lie between 100 and 10000 nm",
        element="spectrum",
        value="0.4",
    ),
    wrong(
        "negative step",
        'step="10"',
        'step="-10"',
        "step must be above 0 and at most 1000 nm",
        element="spectrum",
        value="-10",
    ),
    wrong(
        "step that vanishes",
        'step="10"',
        f'step="0.{"0" * 400}1"',
        "step must be above 0 and at most 1000 nm",
        element="spectrum",
        value="0." + "0" * 78 + "…",
    ),
    wrong(
        "texture beyond the largest double",
        'value="3.21"',
        f'value="{_TOO_LONG}"',
        "value must be a finite number",
        element="texture",
        value=_TOO_LONG[:80] + "…",
    ),
    wrong(
        "negative difference",
        'dE="2.5"',
        'dE="-2.5"',
        "dE must be a finite number, 0 or more",
        element="difference",
        value="-2.5",
    ),
    wrong(
        "no reading averaged",
        "<averaged>3",
        "<averaged>0",
        "averaged must be a whole number, 1 or more",
        element="averaged",
        value="0",
    ),
    wrong(
        "half a reading averaged",
        "<averaged>3",
        "<averaged>2.5",
        "averaged must be a whole number",
        element="averaged",
        value="2.5",
    ),
]

WORDS = [
    wrong(
        "unknown finish",
        ">metallic<",
        ">shiny<",
        "finish must be one of solid, metallic, pearl, unknown",
        element="finish",
        value="shiny",
    ),
    wrong(
        "finish in capitals",
        ">metallic<",
        ">Metallic<",
        "finish must be one of",
        element="finish",
        value="Metallic",
    ),
    wrong(
        "unknown illuminant",
        '"D65"',
        '"D50"',
        "illuminant must be D65: convert the values first",
        element="samples",
        value="D50",
    ),
    wrong(
        "light from elsewhere",
        'illumination="45"',
        'illumination="15"',
        "illumination must be 45 degrees",
        element="samples",
        value="15",
    ),
    wrong(
        "observer 7",
        'observer="10"',
        'observer="7"',
        "observer must be one of 10, 2 degrees",
        element="samples",
        value="7",
    ),
    wrong(
        "unknown origin",
        ">simulated<",
        ">dreamt<",
        "origin must be one of real, simulated",
        element="origin",
        value="dreamt",
    ),
    wrong(
        "unknown calibration state",
        ">valid<",
        ">good<",
        "calibration must be one of valid, needed, unknown",
        element="calibration",
        value="good",
    ),
    wrong(
        "text too long",
        ">Quartz Silver<",
        f">{'x' * 501}<",
        "name must hold at most 500 characters",
        element="name",
        value="x" * 80 + "…",
    ),
    wrong(
        "escape sequence of a terminal",
        ">Quartz Silver<",
        ">Quartz\x9b2J<",
        "none of them a control character",
        element="name",
        value="Quartz\x9b2J",
    ),
    wrong(
        "control character in an attribute",
        '"graininess"',
        '"grain\x7f"',
        "name must hold at most 500 characters, none of them a control character",
        element="texture",
        value="grain\x7f",
    ),
]

_TIMES = {
    "time without zone": "2025-03-14T09:26:53",
    "time with an offset": "2025-03-14T10:26:53+01:00",
    "time finer than microseconds": "2025-03-14T09:26:53.5897931Z",
    "leap second": "2016-12-31T23:59:60Z",
    "hour 24": "2025-03-14T24:00:00Z",
    "day that is not": "2025-02-29T09:26:53Z",
    "year 0": "0000-03-14T09:26:53Z",
    "date alone": "2025-03-14",
    "time as people write it": "14.03.2025 09:26",
}

TIMES = [
    wrong(
        name,
        "2025-03-14T09:26:53.589793Z",
        value,
        "time must be a time in UTC such as",
        element="time",
        value=value,
    )
    for name, value in _TIMES.items()
]

_TWICE = "an aspecular angle stands twice: keep one"

ANGLES = [
    wrong(
        "angle twice",
        'aspecular="45" L',
        'aspecular="15" L',
        f"{_TWICE} sample",
        element="sample",
        value="15",
    ),
    wrong(
        "angle twice in two spellings",
        'aspecular="45" L',
        'aspecular="15.00" L',
        f"{_TWICE} sample",
        element="sample",
        value="15.00",
    ),
    wrong(
        "spectrum twice",
        'aspecular="45" start',
        'aspecular="15" start',
        f"{_TWICE} spectrum",
        element="spectrum",
        value="15",
    ),
    wrong(
        "difference twice",
        'aspecular="45" dE',
        'aspecular="15" dE',
        f"{_TWICE} difference",
        element="difference",
        value="15",
    ),
    # To libxml2 these are two angles; the model knows better, but not which line.
    Case(
        "zero in two signs",
        edited('"110" L', '"-0" L', edited('"45" L', '"0" L')),
        f"{_TWICE} of the two samples",
        line=2,
        element="sample",
        value="0",
    ),
]

VALUES = NUMBERS + LIMITS + WORDS + TIMES + ANGLES
