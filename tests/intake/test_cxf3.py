"""CxF3 against colour-cxf, an independent reader and writer."""

from __future__ import annotations

import re
import time
from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from colour_cxf import cxf3, read_cxf

from paintlink.errors import InputError
from paintlink.export import JobFacts, load_formats, render
from paintlink.intake import Import, Item, Options, read_any
from paintlink.model import ColorSpec
from tests.intake.fixtures import paint
from tests.intake.fixtures.cxf3 import ANGLES, document

FORMAT = load_formats()["cxf3"]


def imported(data: bytes | str, **options: object) -> Import:
    content = data.encode() if isinstance(data, str) else data
    return read_any(content, name="a.cxf", options=Options(**options))  # type: ignore[arg-type]


def only(data: bytes | str, **options: object) -> Item:
    (item,) = imported(data, **options).items
    return item


def spec_of(item: Item) -> ColorSpec:
    assert item.spec is not None, item.refused
    return item.spec


def text(*, names: tuple[str, ...] = ("Basalt 7",)) -> str:
    """The fixture without namespace prefixes, one element on a line."""
    return document(names).decode().replace("ns0:", "").replace(
        "xmlns:ns0", "xmlns"
    ).replace("><", ">\n<")  # fmt: skip


def edited(old: str, new: str, count: int = 1) -> str:
    assert old in text()
    return text().replace(old, new, count)


def refusal(data: bytes | str) -> str:
    with pytest.raises(InputError, match=r"a\.cxf") as caught:
        imported(data)
    return str(caught.value)


def exported(spec: ColorSpec, origin: str = "real") -> bytes:
    facts = JobFacts("k7p2m5q3xa", datetime(2026, 3, 14, tzinfo=UTC), origin)  # type: ignore[arg-type]
    return render(spec, FORMAT, job=facts).data


def test_file_written_by_colour_cxf_is_read_back() -> None:
    item = imported(document()).items[0]

    assert item.name == "Basalt 7"
    reading = item.reading
    assert reading is not None
    measured = reading.measurement
    assert [one.code for one in measured.geometries] == [*ANGLES]
    assert measured.spectra is not None
    assert measured.lab is not None
    spectra = paint.factors(tuple(ANGLES), 0)
    assert np.array_equal(measured.spectra.factors, spectra)
    assert np.array_equal(measured.lab.lab, paint.lab(spectra))
    assert measured.gloss is not None
    assert (measured.gloss.value_gu, measured.gloss.angle_deg) == (91.5, 60.0)
    assert measured.data_mode == "XRGA"
    assert reading.instrument.serial == "004711"
    assert reading.taken_at == datetime(2026, 3, 14, 8, 26, 53, tzinfo=UTC)


def test_our_file_is_read_by_colour_cxf() -> None:
    spec = replace(spec_of(imported(document()).items[0]), finish="pearl")

    found = read_cxf(exported(spec))

    assert found.resources is not None
    assert found.resources.object_collection is not None
    assert found.resources.color_specification_collection is not None
    (item,) = found.resources.object_collection.object_value
    assert item.name == "Basalt 7"
    assert item.color_values is not None
    specs = {
        one.id: one
        for one in found.resources.color_specification_collection.color_specification
    }
    told: dict[float, tuple[float, ...]] = {}
    for value in item.color_values.choice:
        measured = specs[value.color_specification].measurement_spec  # type: ignore[union-attr]
        assert measured is not None
        assert measured.geometry_choice is not None
        (angle,) = measured.geometry_choice.choice.brdfangle  # type: ignore[union-attr]
        assert angle.illumination_angle == 45.0
        if isinstance(value, cxf3.ColorCielab):
            told[angle.aspecular] = (value.l, value.a, value.b)  # type: ignore[index, assignment]
        else:
            assert isinstance(value, cxf3.ReflectanceSpectrum)
            assert measured.wavelength_range == cxf3.WavelengthRange(400, 10)
            mine = {one.aspecular_deg: one for one in spec.spectra}
            assert tuple(value.value) == mine[angle.aspecular].factors  # type: ignore[index]
    assert told == {one.aspecular_deg: tuple(one.lab) for one in spec.samples}


def test_our_file_comes_back_as_the_same_specification() -> None:
    spec = replace(spec_of(imported(document()).items[0]), finish="pearl", code="AB-1")

    back = spec_of(only(exported(spec)))

    assert back == spec


def test_simulated_origin_survives_the_way_through_a_file() -> None:
    spec = spec_of(imported(document()).items[0])

    back = only(exported(spec, "simulated"))

    assert back.reading is not None
    assert back.reading.origin == "simulated"
    assert back.spec is not None
    assert back.spec.provenance is not None
    assert back.spec.provenance.origin == "simulated"


def test_other_encodings_are_read_as_declared() -> None:
    latin = edited('Name="Basalt 7"', 'Name="Blau Größe"').replace(
        "UTF-8", "ISO-8859-1"
    )

    assert only(latin.encode("latin-1")).name == "Blau Größe"
    sixteen = latin.replace("ISO-8859-1", "UTF-16").encode("utf-16")
    assert only(sixteen).name == "Blau Größe"
    marked = b"\xef\xbb\xbf" + latin.replace("ISO-8859-1", "UTF-8").encode()
    assert only(marked).name == "Blau Größe"


def test_text_that_is_not_in_its_declared_encoding_is_told() -> None:
    latin = edited('Name="Basalt 7"', 'Name="Größe"').encode("latin-1")

    assert "not the UTF-8 it says it is: save it as UTF-8" in refusal(latin)


def test_vendor_elements_are_passed_over() -> None:
    data = edited("<ColorValues>", '<vendor:x xmlns:vendor="urn:v"/>\n<ColorValues>')

    assert len(spec_of(only(data)).samples) == 6


def test_number_that_is_none_is_told_with_its_line() -> None:
    data = edited("<Aspecular>15.0<", "<Aspecular>minus<")
    line = data[: data.index('<BRDFAngle Notation="45as15"')].count("\n") + 1

    assert refusal(data).startswith(
        f"a.cxf, line {line}: not a number: correct it or export again"
    )


def test_decimal_comma_is_told_with_its_value() -> None:
    data = re.sub(r"<L>(\d+)\.(\d+)", r"<L>\1,\2", text(), count=1)

    assert re.search(r"line \d+: a decimal comma where .* \(found '\d+,", refusal(data))


def test_cut_spectrum_is_told() -> None:
    data = re.sub(r"(ReflectanceSpectrum [^>]*>)\S+ ", r"\1", text(), count=1)

    assert "on different wavelengths" in refusal(data)


def test_percent_is_told_with_the_option() -> None:
    def percent(found: re.Match[str]) -> str:
        values = " ".join(f"{100 * float(one):.3f}" for one in found[2].split())
        return found[1] + values

    data = re.sub(r"(<ReflectanceSpectrum [^>]*>)([^<]+)", percent, text())

    assert "import with --scale percent" in refusal(data)
    assert len(spec_of(only(data, scale="percent")).samples) == 6


def test_missing_angle_is_refused_for_the_object() -> None:
    data = re.sub(
        r'<ReflectanceSpectrum Name="45as(110|-15)"[^<]*</ReflectanceSpectrum>',
        "",
        text(),
    )
    data = re.sub(
        r'<ColorCIELab Name="45as(110|-15)".*?</ColorCIELab>', "", data, flags=re.DOTALL
    )

    item = only(data)

    assert item.spec is None
    assert "it holds the aspecular angles 15, 25, 45, 75: a specification needs" in (
        item.refused
    )


def test_doubled_geometry_is_told_with_both_lines() -> None:
    data = edited("<Aspecular>25.0<", "<Aspecular>15.0<").replace(
        'Notation="45as25"', 'Notation="r45as15"'
    )

    assert re.search(
        r"line \d+: geometry r45as15 stands twice in one reading, before as 45as15 in "
        r"line \d+: remove one",
        refusal(data),
    )


def test_notation_that_contradicts_its_angles_is_told() -> None:
    data = edited("<Aspecular>25.0<", "<Aspecular>24.0<")

    assert "the notation and the angles beside it disagree" in refusal(data)


def test_several_angles_in_one_specification_need_matching_names() -> None:
    first = text().index("<BRDFAngle")
    end = text().index("</BRDFAngle>") + len("</BRDFAngle>")
    angle = text()[first:end]
    others = "".join(
        angle.replace("45as15", code).replace(">15.0<", f">{value}<")
        for code, value in ANGLES.items()
        if code != "45as15"
    )
    data = text()[:end] + others + text()[end:]
    data = re.sub(
        r'ColorSpecification="spec [^"]*"', 'ColorSpecification="spec 45as15"', data
    )

    assert len(spec_of(only(data)).samples) == 6
    assert "none of their notations: export one" in refusal(
        data.replace('Name="45as25"', 'Name="x"')
    )


def test_unknown_illuminant_leaves_lab_out_and_says_so() -> None:
    found = imported(text().replace(">D65<", ">F2<"))

    assert spec_of(found.items[0]).samples
    assert any("Lab left out: illuminant 'F2' is unknown" in n for n in found.notes)


def test_unknown_illuminant_without_spectra_leaves_nothing() -> None:
    data = re.sub(
        r"<ReflectanceSpectrum.*?</ReflectanceSpectrum>", "", text(), flags=re.DOTALL
    ).replace(">D65<", ">F2<")

    assert "holds no readings: export it again" in refusal(data)


def test_sphere_geometry_gives_solids_only() -> None:
    block = re.search(r"<MultiAngle>.*?</MultiAngle>", text(), re.DOTALL)
    assert block is not None
    names = "|".join(re.escape(code) for code in ANGLES if code != "45as15")
    data = re.sub(rf'<ReflectanceSpectrum Name="({names})"[^<]*<[^>]*>', "", text())
    data = re.sub(
        rf'<ColorCIELab Name="({names})".*?</ColorCIELab>', "", data, flags=re.DOTALL
    )
    sphere = "<SphereGeometry>Specular_{}</SphereGeometry>"

    excluded = data.replace(block[0], sphere.format("Excluded"))
    included = data.replace(block[0], sphere.format("Included"))

    assert only(excluded).spec is None
    assert spec_of(only(excluded, finish="solid")).angles_deg == (15, 45, 110)
    assert any("solid colours only" in one for one in imported(excluded).notes)
    assert "declare it with --geometry 45as45 (found 'Specular_Included')" in refusal(
        included
    )


def test_cxf2_is_told_apart() -> None:
    data = edited("CxF3-core", "CxF2-core")

    assert "not CxF version 3: expected <CxF xmlns=" in refusal(data)


@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.95])
def test_truncated_file_is_told_with_its_line(share: float) -> None:
    data = text()

    told = refusal(data[: int(share * len(data))])

    assert re.search(r"line \d+: not well-formed XML .*: write the file again", told)


def test_entities_are_refused_at_once() -> None:
    laughs = "".join(f'<!ENTITY x{n} "{f"&x{n - 1};" * 10}">' for n in range(1, 10))
    data = edited("<CxF", f'<!DOCTYPE CxF [<!ENTITY x0 "ha">{laughs}]>\n<CxF').replace(
        "Basalt 7", "&x9;"
    )

    assert "a document type definition (DOCTYPE) is never accepted" in refusal(data)


def test_crowd_of_elements_is_refused_unparsed() -> None:
    data = edited("<ColorValues>", "<ColorValues>" + "<x/>" * 2_000_000)
    start = time.process_time()

    told = refusal(data)

    assert "more elements than files of readings have" in told
    assert time.process_time() - start < 5.0


def test_deep_nesting_is_refused() -> None:
    data = edited("<ColorValues>", "<ColorValues>" + "<x>" * 100_000)

    assert "not well-formed XML" in refusal(data)


def test_element_crowded_with_attributes_is_refused_unparsed() -> None:
    crowd = " ".join(f'a{number}=">"' for number in range(300_000))
    data = edited("<ColorValues>", f"<ColorValues><x {crowd}/>")
    start = time.process_time()

    told = refusal(data)

    assert "an element with hundreds of attributes: export again" in told
    assert time.process_time() - start < 5.0
