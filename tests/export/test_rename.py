from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

RENAME = """
import os, sys
from paintlink.export.rename import rename_noreplace
fd = os.open(sys.argv[1], os.O_RDONLY)
rename_noreplace("old", fd, "new", fd)
"""


@pytest.fixture(params=["", "EINVAL", "ENOSYS", "EOPNOTSUPP"])
def renaming(request: pytest.FixtureRequest) -> list[str]:
    """A command that renames; with an error, where the system knows no such rename."""
    command = [str(Path(sys.executable)), "-c", RENAME]
    if not request.param:
        return command
    if shutil.which("strace") is None:
        pytest.skip("strace is not installed")
    inject = f"inject=renameat2:error={request.param}"
    tracer = ["strace", "-f", "-o", "/dev/null", "-etrace=renameat2", "-e", inject]
    return [*tracer, *command]


def run(command: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*command, str(folder)], capture_output=True, text=True, check=False
    )


def test_file_moves_to_the_free_name(tmp_path: Path, renaming: list[str]) -> None:
    (tmp_path / "old").write_text("ours")

    done = run(renaming, tmp_path)

    assert done.returncode == 0
    assert [path.name for path in tmp_path.iterdir()] == ["new"]
    assert (tmp_path / "new").read_text() == "ours"


@pytest.mark.parametrize("kind", ["file", "dangling link"])
def test_taken_name_is_kept(tmp_path: Path, renaming: list[str], kind: str) -> None:
    (tmp_path / "old").write_text("ours")
    if kind == "file":
        (tmp_path / "new").write_text("theirs")
    else:
        (tmp_path / "new").symlink_to("nowhere")

    done = run(renaming, tmp_path)

    assert "FileExistsError" in done.stderr
    assert (tmp_path / "old").read_text() == "ours"
    assert (tmp_path / "new").is_symlink() or (tmp_path / "new").read_text() == "theirs"


def test_missing_file_is_reported(tmp_path: Path, renaming: list[str]) -> None:
    done = run(renaming, tmp_path)

    assert "FileNotFoundError" in done.stderr
    assert list(tmp_path.iterdir()) == []
