"""Orders, templates, verdicts and labels over a real journal and line."""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from paintlink.config import InstrumentSettings, TemplateSettings
from paintlink.daemon.instruments import InstrumentWorker
from paintlink.daemon.order_worker import OrderWorker, label_facts
from paintlink.errors import ExportError, InputError
from paintlink.export import label
from paintlink.intake import Inbox, InboxFolders, read_order, vin_problem
from tests.daemon.conftest import make_reading
from tests.daemon.test_acknowledge import Calibrated
from tests.daemon.test_line import Shop

GOOD_VIN = "1M8GDM9AXKP042788"
XML = """<order xmlns="urn:paintlink:order:1">
  <template>refinish</template><sample>door</sample><repair_order>4711</repair_order>
  <vin>{vin}</vin><panel>front left</panel>
</order>"""
REFINISH = TemplateSettings(
    name="refinish", readings=2, required=("repair_order",), routes=("json",)
)


class Office:
    """A shop with a jobs folder."""

    def __init__(self, root: Path) -> None:
        self.shop = Shop(root / "shop", "colornet", "json")
        folders = InboxFolders.below(root, root / "jobs", within="jobs")
        folders.create()
        self.folders, self.now = folders, 0.0
        inbox = Inbox(folders, quiet_s=1.0, max_bytes=9999, clock=lambda: self.now)
        self.worker = OrderWorker(self.shop.journal, inbox, (REFINISH,))

    def order(self, name: str, text: str) -> None:
        (self.folders.inbox / name).write_text(text)
        self.worker.step()
        self.now += 5.0
        while self.worker.step():
            pass

    def reason(self, name: str) -> str:
        return (self.folders.failed / f"{name}.reason.txt").read_text()


@pytest.fixture
def office(tmp_path: Path) -> Office:
    return Office(tmp_path)


def test_readings_of_an_order_become_one_averaged_job(office: Office) -> None:
    office.order("a.xml", XML.format(vin=GOOD_VIN))
    journal = office.shop.journal
    first = replace(make_reading(raw=b"1"), sample="door")
    factors = first.measurement.spectra
    assert factors is not None
    brighter = replace(
        first,
        measurement=replace(
            first.measurement,
            raw=b"2",
            spectra=replace(factors, factors=factors.factors * 1.1),
        ),
    )

    token = journal.accept_reading(first, source="bench")
    office.shop.drain()
    collecting = office.shop.job(token).state
    again = journal.accept_reading(first, source="bench")
    second = journal.accept_reading(brighter, source="bench")
    office.shop.drain()

    job = office.shop.job(token)
    assert (collecting, again, second) == ("collecting", token, token)
    assert (job.state, len(journal.readings_of(job.id))) == ("done", 2)
    assert job.spec is not None
    assert job.spec.provenance is not None
    mean = np.mean([one.factors for one in job.spec.spectra])
    assert mean == pytest.approx(factors.factors.mean() * 1.05)
    assert [one.route for one in job.deliveries] == ["json"]
    assert journal.orders.waiting() == ()
    assert list(journal.trail.faults()) == []


def test_machine_and_human_verdicts_stand_side_by_side(office: Office) -> None:
    office.order("a.json", '{"sample": "door"}')
    journal = office.shop.journal
    token = journal.accept_reading(
        replace(make_reading(), sample="door"), source="bench"
    )
    office.shop.drain()
    job = office.shop.job(token)

    journal.orders.judge(job.id, "human", "pass", note="good enough for a van")

    machine, human = journal.orders.verdicts(job.id)
    assert (machine.judge, machine.verdict) == ("machine", "fail")
    assert set(machine.angles) == {"15", "45", "110"}
    assert (human.judge, human.verdict) == ("human", "pass")
    assert human.note == "good enough for a van"


def test_same_order_twice_is_one(office: Office) -> None:
    office.order("a.xml", XML.format(vin=GOOD_VIN))
    office.order("b.xml", XML.format(vin=GOOD_VIN))

    assert len(office.shop.journal.orders.waiting()) == 1


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("vin.xml", XML.format(vin="1M8GDM9A0KP042788"), "it should be X"),
        ("short.xml", XML.format(vin="1M8"), "a VIN has 17 characters"),
        ("o.xml", XML.format(vin="1M8GDM9AXKPO42788"), "'O' cannot stand in a VIN"),
        ("field.json", '{"sample": "x", "colour": "red"}', "unknown field 'colour'"),
        ("number.json", '{"sample": 3}', "must be a text"),
        ("list.json", "[1]", "expected one JSON object"),
        ("broken.json", '{"sample": ', "neither XML nor JSON"),
        ("empty.json", "{}", "sample is missing"),
        ("deep.json", "[" * 5000, "neither XML nor JSON"),
        ("other.xml", "<order><sample>x</sample></order>", "no order: expected"),
        ("bomb.xml", "<!DOCTYPE a [<!ENTITY b 'c'>]><order>&b;</order>", "DOCTYPE"),
        ("t.json", '{"sample": "x", "template": "y"}', "no template 'y'"),
        ("r.json", '{"sample": "x", "template": "refinish"}', "requires repair_order"),
    ],
)
def test_faulty_orders_are_refused_by_name(
    office: Office, name: str, text: str, reason: str
) -> None:
    office.order(name, text)

    assert reason in office.reason(name)
    assert office.shop.journal.orders.waiting() == ()


def test_check_digit_is_asked_where_it_is_required_only() -> None:
    assert vin_problem(GOOD_VIN) is None
    assert vin_problem("11111111111111111") is None
    assert vin_problem("WVWZZZ1JZXW000001") is None
    assert "it should be" in str(vin_problem("1M8GDM9A1KP042788"))


def test_digits_of_other_scripts_are_no_vin() -> None:
    assert "cannot stand in a VIN" in str(vin_problem("1M8GDM9AXKP04278٨"))


def test_labels_carry_the_job_and_stay_harmless(office: Office) -> None:
    office.order("a.json", '{"sample": "<b>^XZ~door</b>"}')
    token = office.shop.journal.accept_reading(
        replace(make_reading(), sample="<b>^XZ~door</b>"), source="bench"
    )
    office.shop.drain()
    job = office.shop.job(token)
    facts = label_facts(job, office.shop.journal.orders.of_job(job.order_id))

    page, zpl = label("html", facts), label("zpl", facts)

    assert "<svg" in page
    assert "&lt;b&gt;^XZ~door" in page
    assert "<b>^XZ" not in page
    assert zpl.startswith("^XA")
    assert zpl.count("^XZ") == 1
    assert f"^FDMA,{token}^FS" in zpl
    assert "~" not in zpl


def test_site_label_is_sandboxed_and_explained(office: Office) -> None:
    facts = {"job": "abc"}

    assert label("zpl", facts, "{{ job }}!") == "abc!"
    for text in ("{{ job", "{{ job.__class__.__mro__ }}", "{{ 1 / 0 }}"):
        with pytest.raises(ExportError, match="does not work"):
            label("zpl", facts, text)


def test_order_reader_names_its_file() -> None:
    with pytest.raises(InputError, match=r"^x\.json: sample is missing"):
        read_order(b"{}", source="x.json")


def test_next_readings_of_a_named_instrument_fulfil_the_order(
    office: Office, tmp_path: Path
) -> None:
    told: list[str] = []
    bound = replace(REFINISH, name="bound", required=(), instruments=("bench",))
    office.worker._templates = (bound,)
    office.order("a.json", '{"template": "bound", "sample": "door left"}')
    journal = office.shop.journal
    worker = InstrumentWorker(
        InstrumentSettings(name="bench", driver="xrite_ma", port="/dev/null"),
        office.shop.settings.journal_path,
        stop=threading.Event(),
        wake_line=lambda: told.append("line"),
    )
    worker._journal = journal
    named = replace(make_reading(raw=b"0"), sample="door left")

    other = journal.accept_reading(named, source="other")
    for raw in (b"1", b"2", b"3"):
        worker._accept(make_reading(raw=raw), Calibrated())  # type: ignore[arg-type]
    office.shop.drain()

    third, ordered, aside = journal.jobs()
    assert aside.token == other
    assert aside.order_id is None
    assert ordered.order_id is not None
    assert [one.sample for one in journal.readings_of(ordered.id)] == ["door left"] * 2
    assert (third.order_id, journal.reading(third.reading_id or 0).sample) == (
        None,
        "bonnet",
    )
    assert journal.orders.next_for("bench") is None
