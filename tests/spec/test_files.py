from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from paintlink.errors import SpecError
from paintlink.spec import read_spec, read_spec_file
from tests.spec.corpus import COMPLETE


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "quartz.xml"
    path.write_text(COMPLETE)
    return path


def test_file_is_read(file: Path) -> None:
    assert read_spec_file(file) == read_spec(COMPLETE.encode())


def test_link_to_a_file_is_read(file: Path, tmp_path: Path) -> None:
    link = tmp_path / "link.xml"
    link.symlink_to(file)

    assert read_spec_file(str(link)) == read_spec(COMPLETE.encode())


def test_refusal_names_the_file(file: Path) -> None:
    file.write_text(COMPLETE.replace('L="60.1"', 'L="171"'))

    with pytest.raises(SpecError, match=r"quartz\.xml, line 8, <sample>: L must lie"):
        read_spec_file(file)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(
        SpecError, match=r"lost\.xml: cannot be read \(No such file .*: name an XML"
    ) as caught:
        read_spec_file(tmp_path / "lost.xml")

    assert caught.value.source == str(tmp_path / "lost.xml")


def test_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match=r"cannot be read \(Is a directory\)"):
        read_spec_file(tmp_path)


def test_link_to_itself_is_refused(tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to(tmp_path / "loop")

    with pytest.raises(SpecError, match=r"cannot be read \(Too many levels of symb"):
        read_spec_file(tmp_path / "loop")


def test_empty_file_is_refused(file: Path) -> None:
    file.write_bytes(b"")

    with pytest.raises(SpecError, match=r"quartz\.xml: the file is empty"):
        read_spec_file(file)


def test_fifo_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")

    with pytest.raises(SpecError, match="not a regular file: name the XML file"):
        read_spec_file(tmp_path / "fifo")


def test_socket_is_refused(tmp_path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(tmp_path / "socket"))

        with pytest.raises(SpecError, match="cannot be read"):
            read_spec_file(tmp_path / "socket")


def test_endless_device_is_refused() -> None:
    with pytest.raises(SpecError, match="not a regular file"):
        read_spec_file("/dev/zero")


def test_path_with_nul_is_refused() -> None:
    with pytest.raises(SpecError, match=r"cannot be read \(embedded null byte\)"):
        read_spec_file("quartz\0.xml")


def test_large_file_is_refused_unread(file: Path) -> None:
    os.truncate(file, 1 << 40)

    with pytest.raises(SpecError, match=r"larger than 1048576 bytes.*1099511627776"):
        read_spec_file(file)


def test_failed_reads_leave_no_descriptor_open(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")
    before = len(list(Path("/proc/self/fd").iterdir()))

    for path in (tmp_path, tmp_path / "fifo", tmp_path / "lost.xml"):
        with pytest.raises(SpecError, match="file"):
            read_spec_file(path)

    assert len(list(Path("/proc/self/fd").iterdir())) == before
