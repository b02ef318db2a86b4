"""Tables with mapping profiles: those of the site, the built-in one, proposed ones."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import ConfigError, InputError
from paintlink.export import JobFacts, load_formats, render
from paintlink.intake import (
    Import,
    Options,
    Profile,
    Source,
    load_profile,
    load_profiles,
    propose,
    read_any,
)
from tests.daemon.conftest import make_spec
from tests.intake.fixtures import paint
from tests.intake.fixtures.csv_table import document, long, wide

REAL = Path(__file__).parents[2] / "../shared/data/mat12_sample.csv"


def proposed(text: str | bytes, folder: Path) -> Profile:
    data = text.encode() if isinstance(text, str) else text
    path = folder / "proposed.toml"
    path.write_text(propose(Source("table.csv", data)).text)
    return load_profile(path)


def imported(text: str | bytes, *profiles: Profile, **options: object) -> Import:
    data = text.encode() if isinstance(text, str) else text
    given = Options(profiles=profiles, **options)  # type: ignore[arg-type]
    return read_any(data, name="table.csv", options=given)


@pytest.fixture
def shop(tmp_path: Path) -> Profile:
    """The profile proposed for the wide table."""
    return proposed(wide(), tmp_path)


@pytest.fixture
def lab(tmp_path: Path) -> Profile:
    """The profile proposed for the long table."""
    return proposed(long(), tmp_path)


def refusal(text: str | bytes, *profiles: Profile) -> str:
    with pytest.raises(InputError, match=r"table\.csv") as caught:
        imported(text, *profiles)
    return str(caught.value)


def changed(text: str, line: int, old: str, new: str) -> str:
    """The text with one cell of one line changed, lines counted from 1."""
    lines = text.splitlines()
    assert old in lines[line - 1]
    lines[line - 1] = lines[line - 1].replace(old, new, 1)
    return "\n".join(lines)


def test_real_table_is_read_by_the_profile_proposed_for_it(tmp_path: Path) -> None:
    if not REAL.exists():
        pytest.skip("needs ../shared/data, which is not part of the project")

    found = imported(REAL.read_bytes(), proposed(REAL.read_bytes(), tmp_path))

    assert len(found.items) == 115
    assert all(item.spec for item in found.items)
    assert all(
        len(item.reading.measurement.geometries) == 12
        for item in found.items
        if item.reading
    )


def test_table_with_a_column_for_each_value_is_read(shop: Profile) -> None:
    first, second = imported(wide(), shop).items

    assert (first.name, second.name) == ("Basalt 7", "Basalt 8")
    assert first.spec is not None
    assert first.spec.angles_deg == (-15, 15, 25, 45, 75, 110)
    wanted = paint.lab(paint.factors(("45as-15", *paint.FIVE)))
    assert np.allclose(first.spec.lab(), wanted, atol=0.005)
    assert first.reading is not None
    assert first.reading.instrument.serial == "000123"
    assert [one.name for one in first.reading.measurement.texture] == ["Si 15", "G"]
    assert first.reading.measurement.geometries[0].code == "45as-15"


def test_table_with_a_row_for_each_angle_is_read(lab: Profile) -> None:
    first, _ = imported(long(), lab).items

    assert first.reading is not None
    assert len(first.reading.measurement.geometries) == 12
    assert first.reading.measurement.spectra is not None
    assert np.allclose(
        first.reading.measurement.spectra.factors, paint.factors(paint.MA_T12)
    )


def test_repeated_readings_of_one_name_stay_apart(lab: Profile) -> None:
    heading, *rows = long().splitlines()
    first = rows[:12]

    found = imported("\n".join([heading, *first, *first]), lab)

    assert len(found.items) == 2


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
def test_encodings_of_spreadsheet_programs_are_read(
    encoding: str, shop: Profile
) -> None:
    text = wide().replace("Basalt 7", "Größe 7")

    found = imported(text.encode(encoding), shop)

    assert found.items[0].name == "Größe 7"
    noted = "not UTF-8: read as Windows-1252" in found.notes
    assert noted == (encoding == "cp1252")


def test_our_own_table_comes_back_without_a_profile() -> None:
    spec = replace(make_spec("=grey"), finish="metallic", code="AB-1")
    facts = JobFacts("k7p2m5q3xa", datetime(2026, 3, 14, tzinfo=UTC), "simulated")
    data = render(spec, load_formats()["csv"], job=facts).data

    (item,) = imported(data).items

    assert item.spec is not None
    assert item.spec.name == "=grey"
    assert (item.spec.finish, item.spec.code) == ("metallic", "AB-1")
    assert item.spec.samples == spec.samples
    assert item.reading is not None
    assert item.reading.origin == "simulated"


def test_table_without_profile_is_told_how_to_make_one() -> None:
    assert "no profile fits the headings of this table: make one with `paintlink" in (
        refusal(wide())
    )


def test_profile_that_nearly_fits_is_named_with_what_it_lacks(shop: Profile) -> None:
    text = changed(wide(), 1, "L* 45°", "L 45")

    assert "; 'table' lacks in line 1: l* 45°" in refusal(text, shop)


def test_bad_cell_is_told_with_line_and_column(shop: Profile) -> None:
    lines = wide().splitlines()
    cells = lines[2].split(";")
    cells[3] = "n/a"
    text = "\n".join([*lines[:2], ";".join(cells)])

    assert refusal(text, shop) == (
        "table.csv, line 3, column 'L* -15°': not a number: correct it or export "
        "again (found 'n/a')"
    )


def test_decimal_points_under_a_comma_profile_are_told(shop: Profile) -> None:
    lines = wide().splitlines()
    text = "\n".join([*lines[:2], lines[2].replace(",", ".")])

    assert "line 3, column 'L* -15°': a decimal point where the file has the other" in (
        refusal(text, shop)
    )


def test_thousands_separators_are_told(shop: Profile) -> None:
    cell = wide().splitlines()[1].split(";")[3]

    assert "a number with thousands separators: write it without them" in refusal(
        changed(wide(), 2, cell, "1.234,50"), shop
    )


def test_decimal_commas_in_a_table_cut_by_commas_are_told(tmp_path: Path) -> None:
    profile = proposed(wide(".", ","), tmp_path)
    text = wide(".", ",").splitlines()
    broken = "\n".join([*text[:2], text[2].replace(".", ",")])

    assert "headings: is a decimal comma in a table cut by commas? export it" in (
        refusal(broken, profile)
    )


def test_missing_number_within_an_angle_is_told(shop: Profile) -> None:
    cells = wide().splitlines()[1].split(";")
    cells[4] = ""
    lines = wide().splitlines()
    text = "\n".join([lines[0], ";".join(cells), lines[2]])

    assert "line 2, column 'a* -15°': a number is missing: fill it in" in refusal(
        text, shop
    )


def test_angle_that_is_empty_in_a_row_is_left_out(shop: Profile) -> None:
    cells = wide().splitlines()[1].split(";")
    cells[3:6] = ["", "", ""]
    lines = wide().splitlines()

    found = imported("\n".join([lines[0], ";".join(cells), lines[2]]), shop)

    assert found.items[0].spec is not None
    assert found.items[0].spec.angles_deg == (15, 25, 45, 75, 110)


def test_doubled_geometry_is_told_with_both_lines(lab: Profile) -> None:
    told = refusal(changed(long(), 5, "15as15", "15as-30"), lab)

    assert "line 5: geometry 15as-30 stands twice in one reading, before as" in told
    assert "15as-30 in line 3: remove one of the two" in told


def test_unknown_geometry_is_told_with_its_line(lab: Profile) -> None:
    assert "line 2: geometry 'sphere' is diffuse" in refusal(
        changed(long(), 2, "15as-45", "sphere"), lab
    )


def test_percent_under_a_fraction_profile_is_told(lab: Profile) -> None:
    text = refusal(long(100.0), lab)

    assert "line 2: reflectance" in text
    assert "import with --scale percent" in text
    assert imported(long(100.0), lab, scale="percent").items[0].spec is not None


def test_percent_signs_count_where_every_value_has_one(lab: Profile) -> None:
    lines = long(100.0).splitlines()
    signed = [lines[0]]
    for line in lines[1:]:
        cells = line.split(",")
        signed.append(",".join([*cells[:5], *(f"{cell} %" for cell in cells[5:])]))
    mixed = [*signed[:3], lines[3], *signed[4:]]

    assert imported("\n".join(signed), lab).items[0].spec is not None
    assert "some reflectance values carry a percent sign and others do not" in refusal(
        "\n".join(mixed), lab
    )


def test_unknown_conditions_of_a_row_are_told(shop: Profile) -> None:
    columns = {
        **shop.columns,
        "operator": replace(shop.columns["g"], kind="conditions"),
    }
    profile = replace(shop, columns=columns)
    text = wide().replace("Ada", "F2/10")

    assert "line 2: illuminant 'F2' is unknown (known: D65, D50, A, F11)" in refusal(
        text, profile
    )


def test_time_of_another_form_is_told(shop: Profile) -> None:
    text = changed(wide(), 3, "14.03.2026 09:26", "March 14")

    assert "line 3, time: not a time of the form %d.%m.%Y %H:%M: correct it" in refusal(
        text, shop
    )


def test_heading_that_stands_twice_is_told(shop: Profile) -> None:
    text = changed(wide(), 1, "dE* 15", "L* 15°")

    assert "line 1: heading 'L* 15°' stands twice: rename one" in refusal(text, shop)


def test_unbalanced_quotes_are_told_with_their_line(shop: Profile) -> None:
    assert "damaged table" in refusal(changed(wide(), 3, "Basalt 8", '"Basalt 8'), shop)


def test_cut_table_is_told(lab: Profile) -> None:
    text = long()[: len(long()) - 40]

    assert "line 25, column '" in refusal(text, lab)


def test_dashes_that_only_separate_are_told_from_negative_angles(
    tmp_path: Path,
) -> None:
    text = wide().replace("* -15°", "*m15").replace("* ", "*-").replace("*m15", "*-15")
    dashed = text.replace("L*-15;a*-15;b*-15;", "", 1)
    lines = dashed.splitlines()
    rows = [";".join([*r.split(";")[:3], *r.split(";")[6:]]) for r in lines[1:]]

    profile = proposed("\n".join([lines[0], *rows]), tmp_path)

    assert profile.columns["l*-45°"].geometry == "45as45"


@pytest.mark.parametrize(
    ("heading", "meaning"),
    [
        ("L*(45as-15)", "45as-15 L"),
        ("b_110", "45as110 b"),
        ("15° a*", "45as15 a"),
        ("r45as25 b*", "r45as25 b"),
        ("45as15 400 nm", "45as15 R400"),
        ("L* (D65/10)", "L"),
        ("R 550", "R550"),
        ("Gloss 60°", "gloss 60"),
        ("Glanz", "gloss"),
        ("Sparkle Grade 15", "texture Sparkle Grade 15"),
        ("Messzeit", "time"),
        ("Winkel", "geometry"),
        ("dSi 15", "ignore"),
        ("ΔE 45°", "ignore"),
    ],
)
def test_headings_are_understood(heading: str, meaning: str, tmp_path: Path) -> None:
    text = f"Name;{heading};L 15;L 45;L 110\na;1;1;1;1\nb;2;2;2;2\n"

    found = propose(Source("t.csv", text.encode())).text

    assert f'"{heading}" = "{meaning}"' in found


def test_proposal_names_what_a_person_has_to_check(tmp_path: Path) -> None:
    text = wide().replace("14.03.2026", "03.04.2026")

    proposal = propose(Source("C:\\exports\\shop 7.csv", text.encode()))

    assert 'name = "shop 7"' in proposal.text
    assert 'conditions = "D65/10"  # check: assumed' in proposal.text
    assert "column 'Operator' is not understood and ignored" in proposal.doubts
    slashes = propose(Source("t", text.replace("03.04.2026", "03/04/2026").encode()))
    assert "time_format: day and month may be the other way round" in slashes.doubts


@pytest.mark.parametrize("text", ["one line only", "a,b,c\n1,2,3\n", "x\ty\n" * 5])
def test_no_profile_is_proposed_for_what_is_no_table_of_readings(text: str) -> None:
    with pytest.raises(InputError, match=r"t\.csv: no (table|row of headings)"):
        propose(Source("t.csv", text.encode()))


PROFILE = """format = 1
name = "shop"
[columns]
Sample = "name"
"L 15" = "45as15 L"
"""


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("format = 1", "format = 2", "format must be 1, found 2"),
        ("format = 1", "format = 1\ncolour = 3", "unknown key 'colour'"),
        (
            "format = 1",
            'format = 1\ndelimiter = ";"',
            "delimiter must be one of comma,",
        ),
        ("format = 1", 'format = 1\nconditions = "X/10"', "illuminant 'X' is unknown"),
        ("45as15 L", "45as15 X", "column 'L 15': '45as15 X' is no meaning of a"),
        ("45as15 L", "45as999 L", "column 'L 15': geometry '45as999'"),
        ("45as15 L", "nane", "did you mean 'name'?"),
        ("45as15 L", "L", "values without geometry: map a geometry column"),
        ("45as15 L", "serial", "no column holds Lab or reflectance"),
        ('= "name"', '= "serial"', "no column is the name: map one"),
        ("[columns]", "[columns", "line 3"),
    ],
)
def test_profile_that_cannot_be_used_is_told_why(
    old: str, new: str, told: str, tmp_path: Path
) -> None:
    path = tmp_path / "shop.toml"
    path.write_text(PROFILE.replace(old, new))

    with pytest.raises(ConfigError, match=r"shop\.toml: ") as caught:
        load_profile(path)

    assert told in str(caught.value)


def test_profiles_of_a_folder_come_before_those_that_ship(tmp_path: Path) -> None:
    (tmp_path / "shop.toml").write_text(PROFILE)

    names = [one.name for one in load_profiles(tmp_path)]

    assert names == ["shop", "paintlink table"]


def test_table_without_a_spec_is_read_by_the_built_in_profile() -> None:
    assert len(imported(document()).items) == 2
