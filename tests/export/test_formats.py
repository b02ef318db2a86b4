from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path

import pytest

from paintlink.errors import ConfigError, ExportError
from paintlink.export import Format, JobFacts, load_format, load_formats, render
from paintlink.spec import read_spec

ROOT = Path(__file__).parents[2]
METADATA = {
    "id": "shop",
    "label": "Shop list",
    "suffix": "txt",
    "file-name": "{date}_{name}",
    "starting-paint": "optional",
}


def stylesheet(output: str = "text", body: str = "shop", **changes: str) -> str:
    metadata = METADATA | {key.replace("_", "-"): text for key, text in changes.items()}
    attributes = " ".join(f'{name}="{value}"' for name, value in metadata.items())
    return f"""<xsl:stylesheet version="1.0"
        xmlns:xsl="http://www.w3.org/1999/XSL/Transform">
      <format xmlns="urn:paintlink:export-format:1" {attributes}/>
      <xsl:output method="{output}"/>
      <xsl:template match="/">{body}</xsl:template>
    </xsl:stylesheet>"""


@pytest.fixture
def site(tmp_path: Path) -> Path:
    folder = tmp_path / "formats"
    folder.mkdir(mode=0o755)
    (folder / "shop.xslt").write_text(stylesheet())
    return folder


def test_built_in_formats_need_no_site() -> None:
    formats = load_formats()

    assert {"colornet", "csv", "json"} <= set(formats)
    assert formats.problems == ()
    needing = [one.id for one in formats.values() if one.requires_starting_paint]
    assert needing == ["colornet"]


def test_metadata_of_the_stylesheet_become_the_format(site: Path) -> None:
    found = load_formats(site)["shop"]

    assert found == Format(
        id="shop",
        label="Shop list",
        suffix="txt",
        name_pattern="{date}_{name}",
        requires_starting_paint=False,
        source=site / "shop.xslt",
        transform=found.transform,
    )


def test_site_stylesheet_replaces_the_built_in_one(site: Path) -> None:
    (site / "csv.xslt").write_text(stylesheet(id="csv", label="Our table"))

    assert load_formats(site)["csv"].label == "Our table"


def test_broken_stylesheet_leaves_the_others_usable(site: Path) -> None:
    (site / "broken.xslt").write_text(stylesheet(id="broken").replace("</xsl:st", "<"))
    (site / "nosy.xslt").write_text(
        stylesheet(id="nosy", body="<xsl:value-of select=\"document('/etc/passwd')\"/>")
    )

    formats = load_formats(site)

    assert set(formats) == {*load_formats(), "shop"}
    broken, nosy = map(str, formats.problems)
    assert broken.startswith(f"{site / 'broken.xslt'}, line 6: not well-formed XML")
    assert nosy.startswith(f"{site / 'nosy.xslt'}, line 5: document() in select")


def test_unknown_format_names_those_there_are(site: Path) -> None:
    (site / "broken.xslt").write_text("<")
    formats = load_formats(site)

    with pytest.raises(
        ExportError, match=r"'brokn'; there are .*json, shop; broken: .*broken\.xslt,"
    ) as caught:
        formats.find("brokn")

    assert caught.value.kind == "format"
    assert formats.find("shop") is formats["shop"]


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"id": "Shop"}, "id='Shop' must be lower-case letters"),
        ({"id": "other"}, "id 'other' differs from the file name; make them equal"),
        ({"label": ""}, "label='' must be a short text"),
        ({"suffix": ".txt"}, r"suffix='\.txt' must be up to 8 lower-case letters"),
        ({"suffix": "../x"}, "suffix='../x' must be"),
        ({"file_name": ""}, "file-name='' must be a pattern"),
        ({"file_name": "{user}"}, "no field 'user'; use {date}, {time}"),
        ({"starting_paint": "yes"}, "starting-paint='yes' must be required or opt"),
    ],
)
def test_wrong_metadata_are_refused(
    site: Path, change: dict[str, str], what: str
) -> None:
    (site / "shop.xslt").write_text(stylesheet(**change))

    with pytest.raises(ConfigError, match=rf"shop\.xslt, line 3: .*{what}"):
        load_format(site / "shop.xslt")


def test_stylesheet_without_metadata_is_refused(site: Path) -> None:
    text = stylesheet().replace("urn:paintlink:export-format:1", "urn:other")
    (site / "shop.xslt").write_text(text)

    with pytest.raises(ConfigError, match=r"line 3: <format> at the top is an ext"):
        load_format(site / "shop.xslt")


def test_stylesheet_needs_exactly_one_metadata_element(site: Path) -> None:
    lines = stylesheet().splitlines()
    (site / "shop.xslt").write_text("\n".join(lines[:2] + lines[3:]))

    with pytest.raises(ConfigError, match=r"needs one <format .* found 0"):
        load_format(site / "shop.xslt")


def test_missing_site_folder_stops_the_start(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="No such file or directory; create it or"):
        load_formats(tmp_path / "formats")


@pytest.mark.parametrize("mode", [0o775, 0o757, 0o777])
def test_site_folder_others_can_write_stops_the_start(site: Path, mode: int) -> None:
    site.chmod(mode)

    with pytest.raises(ConfigError, match="others may write to it; run chmod go-w"):
        load_formats(site)


def test_linked_site_folder_stops_the_start(site: Path) -> None:
    link = site.parent / "link"
    link.symlink_to(site)

    with pytest.raises(ConfigError, match="link: a symbolic link"):
        load_formats(link)


def test_stylesheet_others_can_write_is_not_used(site: Path) -> None:
    (site / "shop.xslt").chmod(0o646)

    formats = load_formats(site)

    assert "shop" not in formats
    assert "shop.xslt: others may write to it" in str(formats.problems[0])


def test_linked_stylesheet_is_not_used(site: Path) -> None:
    (site / "copy.xslt").symlink_to(site / "shop.xslt")

    assert "copy.xslt: a symbolic link" in str(load_formats(site).problems[0])


def test_example_of_the_documentation_works(site: Path) -> None:
    page = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    example = next(part for part in page.split("```xml\n") if part[:5] == "<xsl:")
    (site / "shop.xslt").write_text(example.partition("```")[0])
    spec = read_spec((ROOT / "tests/golden/export/designed.xml").read_bytes())
    job = JobFacts("k7p2m5q3xa", datetime(2025, 3, 14, tzinfo=UTC), "real")

    file = render(spec, load_formats(site)["shop"], job=job)

    expected = f"k7p2m5q3xa {spec.name}\r\n"
    assert file.data == expected.encode("windows-1252", "xmlcharrefreplace")
    assert b"\xe9" in file.data
    assert file.name.startswith("20250314_HYPERLINK_http_x_e_end-")


def test_copy_of_a_built_in_format_works(site: Path) -> None:
    text = load_formats()["colornet"].source.read_text(encoding="utf-8")
    (site / "colornet.xslt").write_text(text.replace("UTF-8", "windows-1252"))

    formats = load_formats(site)

    assert formats["colornet"].source == site / "colornet.xslt"
    assert formats.problems == ()


@pytest.mark.skipif(os.geteuid() != 0, reason="giving files away needs root")
def test_stylesheet_of_another_user_is_not_used(site: Path) -> None:
    os.chown(site / "shop.xslt", 12345, 12345)

    problem = str(load_formats(site).problems[0])

    assert "shop.xslt: belongs to user 12345; give it to root" in problem
