"""Damaged copies of a file, always the same ones for a seed."""

from __future__ import annotations

import io
import random
import zipfile
import zlib
from collections.abc import Iterator

NASTY = (
    b"", b"\0", b"-", b",", b";", b"<", b"]]>", b"&", b'"', b"NaN", b"1e999", b"-1e9",
    b"9" * 400, b"\xff\xfe", b"\xef\xbb\xbf", b"[" * 2000, b"<a>" * 300, b"\n", b"=1+1",
    b"&#0;", b"0x10", b"1,5", b"%", b"true", b"null", b"\xc3\x28", b"\x1b[31m",
)  # fmt: skip


def mutants(document: bytes, count: int, seed: int = 0) -> Iterator[bytes]:
    """Damaged copies; an archive is damaged inside as often as outside."""
    chance = random.Random(seed)
    members = _members(document)
    for _ in range(count):
        if members and chance.random() < 0.7:
            yield _packed(members, chance)
        else:
            yield _mutated(document, chance)


def _mutated(data: bytes, chance: random.Random) -> bytes:
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        data = chance.choice(MUTATIONS)(data, chance)
    return data


def _span(data: bytes, chance: random.Random, longest: int = 64) -> tuple[int, int]:
    start = chance.randrange(len(data) + 1)
    return start, min(len(data), start + chance.randrange(longest))


def _cut(data: bytes, chance: random.Random) -> bytes:
    return data[: chance.randrange(len(data) + 1)]


def _flip(data: bytes, chance: random.Random) -> bytes:
    if not data:
        return data
    place = chance.randrange(len(data))
    return data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :]


def _drop(data: bytes, chance: random.Random) -> bytes:
    start, end = _span(data, chance)
    return data[:start] + data[end:]


def _repeat(data: bytes, chance: random.Random) -> bytes:
    start, end = _span(data, chance, 400)
    return data[:end] + data[start:end] * chance.choice((1, 2, 30)) + data[end:]


def _insert(data: bytes, chance: random.Random) -> bytes:
    start, end = _span(data, chance, 8)
    return data[:start] + chance.choice(NASTY) + data[end:]


def _line(data: bytes, chance: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    if len(lines) < 2:
        return data
    line = chance.randrange(len(lines))
    action = chance.randrange(3)
    if action == 0:
        del lines[line]
    elif action == 1:
        lines.insert(chance.randrange(len(lines)), lines[line])
    else:
        chance.shuffle(lines)
    return b"".join(lines)


def _digit(data: bytes, chance: random.Random) -> bytes:
    """Another number in place of one, which keeps the syntax whole."""
    places = [i for i, byte in enumerate(data) if 48 <= byte <= 57]
    if not places:
        return data
    place = chance.choice(places)
    return data[:place] + chance.choice((*NASTY, b"7", b"000")) + data[place + 1 :]


def _encoding(data: bytes, chance: random.Random) -> bytes:
    text = data.decode("latin-1")
    return text.encode(chance.choice(("utf-16", "utf-16-le", "utf-32", "utf-8")))


MUTATIONS = (_cut, _flip, _drop, _repeat, _insert, _insert, _line, _digit, _encoding)


def _members(document: bytes) -> dict[str, bytes]:
    if not document.startswith(b"PK"):
        return {}
    with zipfile.ZipFile(io.BytesIO(document)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _packed(members: dict[str, bytes], chance: random.Random) -> bytes:
    names = sorted(members)
    damaged = chance.choice(names)
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in names:
            data = members[name]
            if name == damaged:
                if chance.random() < 0.05:
                    continue
                data = _mutated(data, chance)
            archive.writestr(name, data)
    return target.getvalue()


def crc(data: bytes) -> int:
    """Short name of a document for messages."""
    return zlib.crc32(data)
