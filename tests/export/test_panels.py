"""A job that is sent again with the panels that were sprayed."""

from __future__ import annotations

import pytest
from lxml import etree

from paintlink.export import JobFacts, load_formats, render
from paintlink.formulation import Panel
from tests.formulation.test_answer import NOON, make_answer, make_target

FORMATS = load_formats()
JOB = {"j": "urn:paintlink:colornet-job:1"}


def facts(panels: int) -> JobFacts:
    proposal = make_answer().proposal
    assert proposal is not None
    sprayed = [Panel(n, proposal, make_target().samples) for n in range(panels)]
    return JobFacts("k7p2m5q3xa", NOON, "real", panels + 1, tuple(sprayed))


def test_colornet_job_carries_every_panel() -> None:
    file = render(make_target(), FORMATS["colornet"], job=facts(2))

    root = etree.fromstring(file.data)
    schema = etree.XMLSchema(
        etree.parse(str(FORMATS["colornet"].source.with_suffix(".xsd")))
    )
    schema.assertValid(root)
    assert root.get("iteration") == "2"
    assert root.xpath("j:panel/@iteration", namespaces=JOB) == ["0", "1"]
    parts = root.xpath("j:panel[2]/j:formula/j:component/@parts", namespaces=JOB)
    assert parts == ["58.75", "41.25"]
    assert root.xpath("j:panel[1]/j:predicted/j:lab[1]/@L", namespaces=JOB) == ["80.35"]
    assert root.xpath("j:panel[1]/j:measured/j:lab[1]/@L", namespaces=JOB) == ["80.1"]
    assert root.xpath("j:target/j:lab[1]/@L", namespaces=JOB) == ["80.1"]


@pytest.mark.parametrize("name", ["csv", "json"])
def test_formats_without_a_place_for_panels_leave_them_out(name: str) -> None:
    with_panels = render(make_target(), FORMATS[name], job=facts(2))
    without = render(
        make_target(), FORMATS[name], job=JobFacts("k7p2m5q3xa", NOON, "real", 3)
    )

    assert with_panels.data == without.data
