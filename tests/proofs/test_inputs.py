"""Impossible and hostile files: kept aside, reaching nothing (P8, P12)."""

from __future__ import annotations

import random
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.proofs.stages import Stages
from tests.proofs.tracing import needs_tracing, traced
from tests.spec.accepted import ACCEPTED
from tests.spec.corpus import Case
from tests.spec.hostile import HOSTILE
from tests.spec.refused_shapes import SHAPES
from tests.spec.refused_values import VALUES

pytestmark = pytest.mark.timeout(300)

SECRET = "the canary sings"


def drop(stages: Stages, cases: list[Case], port: int = 9) -> None:
    (stages.root / "canary").write_text(SECRET)
    for number, case in enumerate(cases):
        path = stages.root / "inbox" / f"{number:04}.xml"
        path.write_bytes(case.data(str(stages.root / "canary"), port))


def mutations(number: int) -> Iterator[bytes]:
    """A hostile document after another with some bytes of it changed."""
    chance = random.Random(12)
    for _ in range(number):
        data = bytearray(chance.choice(HOSTILE).data("/etc/passwd", 9)[:20_000])
        for _ in range(chance.randrange(1, 8)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        yield bytes(data)


def test_impossible_values_are_kept_aside_and_never_exported(tmp_path: Path) -> None:
    stages = Stages(tmp_path / "shop")
    drop(stages, VALUES)

    for stage in ("inbox", "line", "route"):
        stages.run(stage)

    assert len(VALUES) >= 60
    failed = {path.name for path in (stages.root / "failed").glob("*.*")}
    files = {name for name in failed if name.endswith(".xml")}
    assert len(files) == len(VALUES)
    assert {f"{name}.reason.txt" for name in files} == failed - files
    assert list(stages.hot.glob("*.xml")) == []
    with stages.journal() as journal:
        assert journal.jobs() == ()


@needs_tracing
def test_hostile_files_open_call_and_start_nothing(tmp_path: Path) -> None:
    cases = HOSTILE + SHAPES + VALUES + ACCEPTED
    mutated = list(mutations(150))
    warm = Stages(tmp_path / "warm")
    drop(warm, HOSTILE[:5] + ACCEPTED[:5])
    warm.run("inbox")
    stages = Stages(tmp_path / "shop")
    reached: list[tuple[str, str]] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.setblocking(False)
        drop(stages, cases, server.getsockname()[1])
        for number, data in enumerate(mutated):
            (stages.root / "inbox" / f"mutated {number}.xml").write_bytes(data)

        run = traced(
            stages.work("inbox"), reach=lambda call, path: reached.append((call, path))
        )

        with pytest.raises(BlockingIOError):
            server.accept()

    assert run.status == 0
    assert len(cases) + len(mutated) >= 300
    assert {call for call, _ in reached} <= {"open", "openat", "openat2"}
    assert not any("canary" in path for _, path in reached)
    own = (
        str(stages.root),
        "/proc/self/mountinfo",
        "/usr/share/zoneinfo",
        "/etc/",
        "/dev/urandom",
    )
    strange = {
        path for _, path in reached
        if path.startswith("/") and not path.startswith(own) and ".so" not in path
        and not path.endswith((".py", ".pyc", ".xsd")) and "__pycache__" not in path
    }  # fmt: skip
    assert strange == set()
    texts = b"".join(
        path.read_bytes() for path in (stages.root / "failed").glob("*.reason.txt")
    )
    assert SECRET.encode() not in texts
    assert SECRET.encode() not in stages.settings.journal_path.read_bytes()
