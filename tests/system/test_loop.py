"""From a reading to an accepted formula, through files alone."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from paintlink.config import FormulationSettings
from paintlink.formulation import best_step, read_answer, write_answer
from paintlink_simulators.paint import (
    BODY_SHOP_SITE,
    CAREFUL_SITE,
    EXACT_SITE,
    LABORATORY,
    SprayBooth,
    Variation,
)
from tests.cli.conftest import Run, run  # noqa: F401
from tests.simulators.colornet.panels import drawn
from tests.system.loop import LoopShop

STRICT = FormulationSettings(accept_dE00=0.0, panels=3)


@pytest.fixture
def shop(tmp_path: Path) -> LoopShop:
    return LoopShop(tmp_path / "shop", SprayBooth(CAREFUL_SITE, seed=5), STRICT)


def target_panel(seed: int = 11):
    rng = np.random.default_rng(seed)
    return SprayBooth(EXACT_SITE, seed=seed).spray(drawn(rng))


def answered(shop: LoopShop, number: int = 0) -> Path:
    """The file of an answer that was taken."""
    return sorted((shop.folder / "done" / "answers").glob("*.xml"))[number]


def test_panels_come_nearer_and_the_best_is_kept(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    for number in range(3):
        shop.formulate()
        assert [one.iteration for one in shop.journal.formulas.of_job(job.id)] == list(
            range(number + 1)
        )
        panel = shop.spray(job)
        shop.measure(panel, f"{job.token} panel {number}", LABORATORY, 100 + number)

    steps = shop.judge.steps(shop.job(job.token))
    best = best_step(steps)
    assert [step.iteration for step in steps] == [0, 1, 2]
    assert all(step.measured_mean is not None for step in steps)
    assert best is not None
    assert best.measured_mean is not None
    assert best.measured_mean < 1.0
    assert steps[0].predicted_mean < 1.0
    kinds = shop.kinds(job)
    assert kinds.count("answered") == 3
    assert kinds.count("panel") == 3
    assert kinds.count("correction") == 2
    assert kinds[-1] == "stopped"
    assert list(shop.journal.trail.faults()) == []
    last = (shop.folder / "taken").glob("*.xml")
    assert any(b'iteration="2"' in one.read_bytes() for one in last)


def test_good_panel_closes_the_job_with_its_time(tmp_path: Path) -> None:
    rules = FormulationSettings(accept_dE00=1.5)
    shop = LoopShop(tmp_path / "shop", SprayBooth(EXACT_SITE, seed=5), rules)
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.formulate()

    panel = shop.measure(shop.spray(job), f"{job.token} panel", LABORATORY, 2)

    assert shop.states(job) == ["accepted"]
    assert panel.panel_of == job.id
    assert panel.state == "done"
    assert panel.deliveries == ()
    assert shop.kinds(job)[-1] == "accepted"
    minutes = shop.journal.formulas.minutes_to_accepted(job.id)
    assert minutes is not None
    assert 0.0 < minutes < 60.0
    delivery = shop.job(job.token).deliveries[0]
    assert (delivery.state, len(shop.job(job.token).deliveries)) == ("answered", 1)


def test_second_same_answer_is_a_duplicate(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.formulate()
    data = answered(shop).read_bytes()
    (shop.folder / "answers" / "again.xml").write_bytes(data)

    shop.take_answers()

    assert shop.states(job) == ["open"]
    (reason,) = (shop.folder / "duplicate" / "answers").glob("*.reason.txt")
    assert "accepted before as" in reason.read_text()


def failed_reason(shop: LoopShop, data: bytes) -> str:
    (shop.folder / "answers" / "odd.xml").write_bytes(data)
    shop.take_answers()
    reason = shop.folder / "failed" / "answers" / "odd.xml.reason.txt"
    return reason.read_text()


def test_another_answer_to_the_same_question_is_refused(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.formulate()
    other = replace(read_answer(answered(shop).read_bytes()), note="on second thought")

    reason = failed_reason(shop, write_answer(other))

    assert "before, with something else" in reason
    assert shop.states(job) == ["open"]


def test_answer_after_a_resend_replaces_the_first(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.formulate()
    shop.journal.resend(shop.job(job.token), "colornet")
    shop.drain()
    other = replace(read_answer(answered(shop).read_bytes()), note="on second thought")

    (shop.folder / "answers" / "new.xml").write_bytes(write_answer(other))
    shop.take_answers()

    (kept,) = shop.journal.formulas.of_job(job.id)
    assert kept.answer.note == "on second thought"
    assert "superseded" in shop.kinds(job)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"job": "zzzzzzzzzz"}, "is not known here: another shop's"),
        ({"starting_paint": "XX"}, "starts from XX, the job from "),
        ({"iteration": 1}, "answers iteration 1, but only 0 was asked"),
    ],
)
def test_answers_that_do_not_fit_are_refused_by_name(
    shop: LoopShop, changes: dict[str, object], reason: str
) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.watch.step()
    (path,) = (shop.folder / "answers").glob("*.xml")
    answer = read_answer(path.read_bytes())
    path.unlink()

    odd = replace(answer, **changes)  # type: ignore[arg-type]

    assert reason in failed_reason(shop, write_answer(odd))
    assert shop.states(job) == []


def test_toner_the_shop_does_not_have_is_refused(tmp_path: Path) -> None:
    rules = FormulationSettings(toners=("W10",))
    shop = LoopShop(tmp_path / "shop", SprayBooth(EXACT_SITE, seed=5), rules)
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)

    shop.formulate()

    (reason,) = (shop.folder / "failed" / "answers").glob("*.reason.txt")
    assert "is not on the list of this shop" in reason.read_text()
    assert shop.states(job) == []


def test_job_that_was_never_sent_has_no_answers(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.watch.step()
    (path,) = (shop.folder / "answers").glob("*.xml")
    with shop.journal.transaction():
        shop.journal._db.run("UPDATE deliveries SET state = 'failed'")

    shop.take_answers()

    assert shop.states(job) == []
    reason = shop.folder / "failed" / "answers" / f"{path.name}.reason.txt"
    assert "was never sent" in reason.read_text()


def test_refusal_of_the_software_is_kept_with_its_reason(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.watch.step()
    (path,) = (shop.folder / "answers").glob("*.xml")
    answer = replace(
        read_answer(path.read_bytes()), proposal=None, refusal="no such pigment"
    )
    path.write_bytes(write_answer(answer))

    shop.take_answers()

    assert shop.states(job) == ["refused"]
    assert shop.journal.events(job)[-1].text == "no such pigment"


def test_reading_named_like_no_job_is_an_ordinary_one(shop: LoopShop) -> None:
    job = shop.measure(target_panel(), "zzzzzzzzzz panel", LABORATORY, 1)

    assert job.panel_of is None
    assert job.deliveries != ()


def panels_of_a_job(shop: LoopShop, seed: int, site: Variation) -> list[float]:
    """Mean CIEDE2000 of each panel to the target, two corrections at most."""
    job = shop.measure(target_panel(1000 + seed), "bonnet", site.reading, seed)
    for number in range(3):
        shop.formulate()
        if shop.states(job)[-1] == "refused":
            break
        name = f"{job.token} panel {number}"
        shop.measure(shop.spray(job), name, site.reading, 9 * seed + number)
    assert shop.kinds(job)[-1] in {"stopped", "refused"}
    steps = shop.judge.steps(shop.job(job.token))
    return [one.measured_mean for one in steps if one.measured_mean is not None]


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("site", "best_median", "closed"),
    [(CAREFUL_SITE, 0.35, 0.95), (BODY_SHOP_SITE, 0.5, 0.88)],
)
def test_loop_through_files_reaches_its_bars(
    tmp_path: Path, site: Variation, best_median: float, closed: float
) -> None:
    jobs = []
    for seed in range(60):
        booth = SprayBooth(site, seed=seed)
        shop = LoopShop(tmp_path / str(seed), booth, STRICT)
        jobs.append(panels_of_a_job(shop, seed, site))
        shop.journal.close()

    best = np.array([min(one, default=np.inf) for one in jobs])
    second = np.array([one[1] for one in jobs if len(one) > 1])
    share = float((best <= 1.0).mean())
    print(  # noqa: T201
        f"{len(jobs)} jobs: second panel {np.median(second):.2f}, "
        f"95 % below {np.quantile(second, 0.95):.2f}; "
        f"best {np.median(best):.2f}; {share:.1%} closed"
    )
    assert np.median(best) <= best_median
    assert share >= closed


def test_command_line_shows_table_plot_and_split_picture(
    shop: LoopShop,
    tmp_path: Path,
    run: Run,  # noqa: F811
) -> None:
    job = shop.measure(target_panel(), "bonnet", LABORATORY, 1)
    shop.formulate()
    shop.measure(shop.spray(job), f"{job.token} panel", LABORATORY, 2)
    shop.journal.close()
    path = tmp_path / "paintlink.toml"
    path.write_text(
        f'[site]\nfolder = "{shop.folder}"\n[state]\nfolder = "{shop.folder}/state"\n'
    )

    listed = run("formulation", "list", "--config", path)
    shown = run(
        "formulation", "show", job.token, "--config", path, "--plot", "plot.svg",
        "--preview", "split.png",
    )  # fmt: skip
    accepted = run("formulation", "accept", job.token, "--config", path)
    again = run("formulation", "accept", job.token, "--config", path)
    document = run("formulation", "show", job.token, "--config", path, "--json")

    assert job.token in listed.stdout
    assert shown.returncode == 0, shown.stderr
    assert "best panel: iteration 0" in shown.stdout
    assert (tmp_path / "plot.svg").read_text().startswith("<?xml")
    assert (tmp_path / "split.png").read_bytes().startswith(b"\x89PNG")
    assert accepted.returncode == 0, accepted.stderr
    assert "has no open formula" in again.stderr
    (iteration,) = json.loads(document.stdout)["iterations"]
    assert iteration["state"] == "accepted"
    assert sum(iteration["formula"].values()) == pytest.approx(100.0)
