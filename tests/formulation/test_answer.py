"""Answers as XML: whole, hostile and contradictory ones."""

from __future__ import annotations

import random
import shutil
import subprocess
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from paintlink.errors import AnswerError
from paintlink.formulation import (
    Answer,
    Component,
    Formula,
    Proposal,
    mean_error,
    read_answer,
    require_fitting,
    schema_path,
    write_answer,
)
from paintlink.model import ColorSpec, Lab, Sample, StartingPaint

BAD_NUMBER = "is not (accepted by the pattern|a valid value)"
NOON = datetime(2026, 11, 25, 12, 0, tzinfo=UTC)


def make_target() -> ColorSpec:
    labs = {15.0: (80.1, 2.0, -3.5), 45.0: (50.0, 1.0, -2.0), 110.0: (30.0, 0.5, -1.0)}
    samples = tuple(Sample(a, Lab(*lab)) for a, lab in labs.items())
    start = StartingPaint("BM304", "demo", "7", "CIE76", 5.0, ())
    return ColorSpec("bonnet", samples, starting_paint=start)


def make_answer() -> Answer:
    target = make_target()
    predicted = tuple(
        replace(one, lab=one.lab._replace(L=one.lab.L + 0.25)) for one in target.samples
    )
    formula = Formula((Component("WB-1", 58.75), Component("WB-2", 41.25, added=True)))
    remaining = mean_error(target, predicted)
    proposal = Proposal(formula, predicted, "10", remaining)
    return Answer("k7p2m5q3xa", 0, "BM304", proposal, "", "simulated", "stand-in", NOON)


def changed(old: str, new: str) -> bytes:
    text = write_answer(make_answer()).decode()
    assert old in text
    return text.replace(old, new).encode()


def test_answer_round_trips_with_every_digit() -> None:
    answer = make_answer()

    assert read_answer(write_answer(answer)) == answer


def test_refusal_round_trips_with_its_reason() -> None:
    answer = replace(make_answer(), proposal=None, refusal="no toner", note="try RAL")

    assert read_answer(write_answer(answer)) == answer


@pytest.mark.skipif(shutil.which("xmllint") is None, reason="xmllint is not installed")
def test_written_answers_satisfy_the_schema(tmp_path: Path) -> None:
    refusal = replace(make_answer(), proposal=None, refusal="no toner")
    files = [tmp_path / "formula.xml", tmp_path / "refusal.xml"]
    for file, answer in zip(files, (make_answer(), refusal), strict=True):
        file.write_bytes(write_answer(answer))

    subprocess.run(
        ["xmllint", "--noout", "--schema", schema_path(), *files],
        check=True,
        capture_output=True,
    )


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('parts="58.75"', 'parts="-58.75"', BAD_NUMBER),
        ('parts="58.75"', 'parts="−58.75"', BAD_NUMBER),
        ('parts="58.75"', 'parts="٥٨.٧٥"', BAD_NUMBER),
        ('parts="58.75"', 'parts="58,75"', BAD_NUMBER),
        ('parts="58.75"', 'parts="5.875e1"', BAD_NUMBER),
        ('parts="58.75"', 'parts="NaN"', BAD_NUMBER),
        ('parts="58.75"', 'parts="1e400"', BAD_NUMBER),
        ('parts="58.75"', 'parts="50"', "the parts add up to 91.25, not to 100"),
        ('toner="WB-2"', 'toner="WB-1"', "Duplicate key-sequence"),
        ('aspecular="45"', 'aspecular="15"', "Duplicate key-sequence"),
        ('L="50.25"', 'L="500.25"', "L must lie between -16 and 170"),
        ('observer="10"', 'observer="7"', "is not an element of the set"),
        ('job="k7p2m5q3xa"', 'job=""', "pattern"),
        ('iteration="0"', 'iteration="-1"', "not a valid value"),
        ('created="2026-11-25T12', 'created="2026-11-25T25', "not a valid value"),
        ("formulaAnswer", "formulaReply", "no answer to a job"),
        ("answer:1", "answer:2", "no answer to a job"),
        ("<formula>", "<formula><toner/>", "not expected"),
        ("<?xml", "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><?xml",
         "DOCTYPE"),
    ],
)  # fmt: skip
def test_wrong_answers_are_refused_by_name(old: str, new: str, reason: str) -> None:
    with pytest.raises(AnswerError, match=f"^a.xml: .*{reason}"):
        read_answer(changed(old, new), source="a.xml")


def test_mutated_answers_never_crash_the_reader() -> None:
    chance = random.Random(7)
    data = write_answer(make_answer())
    accepted = 0
    for _ in range(2000):
        mutated = bytearray(data)
        for _ in range(chance.randrange(1, 4)):
            mutated[chance.randrange(len(mutated))] = chance.randrange(256)
        try:
            read_answer(bytes(mutated))
            accepted += 1
        except AnswerError:
            pass

    assert 0 < accepted < 2000


def test_fitting_answer_is_taken() -> None:
    require_fitting(make_answer(), make_target(), toners={"WB-1", "WB-2", "WB-3"})


def test_contradictions_are_refused_by_name() -> None:
    target, answer = make_target(), make_answer()
    proposal = answer.proposal
    assert proposal is not None
    wrong = {
        "starts from XX9, the job from BM304": replace(answer, starting_paint="XX9"),
        "predicted for the 2 degree observer": replace(
            answer, proposal=replace(proposal, observer="2")
        ),
        "no predicted colour at 110 degrees": replace(
            answer, proposal=replace(proposal, predicted=proposal.predicted[:2])
        ),
        "states a remaining difference of 9.00": replace(
            answer, proposal=replace(proposal, remaining_dE00=9.0)
        ),
    }
    for text, one in wrong.items():
        with pytest.raises(AnswerError, match=text):
            require_fitting(one, target)
    with pytest.raises(AnswerError, match="toner WB-2 is not on the list"):
        require_fitting(answer, target, toners={"WB-1"})
