from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from paintlink.errors import ExportError
from paintlink.export.folders import explained, opened


@pytest.mark.parametrize(
    ("code", "kind", "advice"),
    [
        (errno.ENOENT, "missing", "create it, connect its share, or correct"),
        (errno.ENOTDIR, "not-a-folder", "remove it or correct the folder"),
        (errno.ELOOP, "not-a-folder", "remove it or correct the folder"),
        (errno.EACCES, "denied", "give its user read, write and search permission"),
        (errno.EPERM, "denied", "give its user read, write and search permission"),
        (errno.EROFS, "read-only", "mount it for writing"),
        (errno.ENOSPC, "full", "free some space"),
        (errno.EDQUOT, "full", "free some space"),
        (errno.ENAMETOOLONG, "name", "shorten the file-name pattern"),
        (errno.EEXIST, "exists", "take it away, or resend"),
        (errno.EIO, "io", "Input/output error; check the disk, or the network share"),
        (errno.ESTALE, "io", "Stale file handle; check the disk, or the network share"),
    ],
)
def test_every_fault_says_what_to_do(code: int, kind: str, advice: str) -> None:
    with (
        pytest.raises(ExportError, match=rf"^/srv/hot: .*{advice}") as caught,
        explained(Path("/srv/hot")),
    ):
        raise OSError(code, os.strerror(code))

    assert caught.value.kind == kind
    assert isinstance(caught.value.__cause__, OSError)


def test_descriptor_is_closed_after_a_failure(tmp_path: Path) -> None:
    with pytest.raises(KeyError, match="x"), opened(tmp_path) as fd:
        raise KeyError("x")

    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(fd)
