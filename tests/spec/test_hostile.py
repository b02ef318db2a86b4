"""The hostile documents under strace: nothing they name is opened or called."""

from __future__ import annotations

import encodings
import json
import re
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.spec.accepted import ACCEPTED
from tests.spec.corpus import edited
from tests.spec.hostile import HOSTILE, TYPE_DECLARATIONS

READ_ALL = Path(__file__).with_name("read_all.py")
CASES = HOSTILE + ACCEPTED
SECRET = "the canary sings"
_PATH = re.compile(r'"([^"]*)"')


class Watched(NamedTuple):
    """What a reader of the hostile documents said and did."""

    reader: str
    answers: list[list[str]]
    calls: list[str]
    server: socket.socket


@pytest.fixture(scope="module", params=["file", "parser"])
def watched(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Watched]:
    """The whole reader at work, then the parser without the checks before it."""
    if shutil.which("strace") is None:
        pytest.skip("strace is not installed")
    home = tmp_path_factory.mktemp("hostile")
    folder = home / "inbox"
    folder.mkdir()
    canary = home / "canary"
    canary.write_text(SECRET)
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.setblocking(False)
        for number, case in enumerate(CASES):
            data = case.data(str(canary), server.getsockname()[1])
            (folder / f"{number:03}.xml").write_bytes(data)
        (folder / "warm-up").write_text(edited("metallic", "shiny"))
        answers, calls = _watch(request.param, folder, home / "trace")
        yield Watched(request.param, answers, calls, server)


def _watch(reader: str, folder: Path, trace: Path) -> tuple[list[list[str]], list[str]]:
    strace = [
        "strace",
        "-f",
        "-o",
        str(trace),
        "-e",
        "trace=connect,open,openat,openat2",
    ]
    done = subprocess.run(
        [*strace, sys.executable, str(READ_ALL), reader, str(folder)],
        capture_output=True,
        text=True,
        check=False,
    )
    if "ptrace" in done.stderr:
        pytest.skip("this machine does not let strace watch")
    assert done.returncode == 0, done.stderr
    calls = trace.read_text().splitlines()
    return json.loads(done.stdout), _between(calls, "begin", "end")


def _between(calls: list[str], first: str, last: str) -> list[str]:
    marks = [
        number
        for number, call in enumerate(calls)
        if f"/{first}" in call or f"/{last}" in call
    ]
    assert len(marks) == 2
    return calls[marks[0] + 1 : marks[1]]


def test_reader_says_something_about_each(watched: Watched) -> None:
    kinds = [kind for kind, _ in watched.answers]

    refused = HOSTILE if watched.reader == "file" else TYPE_DECLARATIONS
    assert kinds[: len(refused)] == ["refused"] * len(refused)
    assert kinds[len(HOSTILE) :] == ["read"] * len(ACCEPTED)


def test_reader_opens_its_documents_only(watched: Watched) -> None:
    opened = [found[1] for found in map(_PATH.search, watched.calls) if found]

    codecs = f"{Path(encodings.__file__).parent}/"
    others = [path for path in opened if not path.startswith(codecs)]
    assert [Path(path).name for path in others] == [
        f"{number:03}.xml" for number in range(len(CASES))
    ]


def test_reader_calls_nobody(watched: Watched) -> None:
    assert not [call for call in watched.calls if "connect" in call]
    with pytest.raises(BlockingIOError, match="temporarily unavailable"):
        watched.server.accept()


def test_canary_is_never_quoted(watched: Watched) -> None:
    assert not [text for _, text in watched.answers if SECRET in text]


def test_watching_would_notice_an_open_canary(tmp_path: Path) -> None:
    if shutil.which("strace") is None:
        pytest.skip("strace is not installed")
    canary = tmp_path / "canary"
    canary.write_text(SECRET)
    text = f'<!DOCTYPE x [<!ENTITY x SYSTEM "{canary}">]><x>&x;</x>'
    program = (
        "import sys; from lxml import etree; parser = etree.XMLParser("
        "resolve_entities=True); print(etree.fromstring(sys.argv[1], parser).text)"
    )
    trace = tmp_path / "trace"
    strace = ["strace", "-f", "-o", str(trace), "-e", "trace=open,openat"]

    done = subprocess.run(
        [*strace, sys.executable, "-c", program, text],
        capture_output=True,
        text=True,
        check=True,
    )

    assert SECRET in done.stdout
    assert str(canary) in trace.read_text()
