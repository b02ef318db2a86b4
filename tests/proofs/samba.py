"""A Samba server of its own on loopback, and its share mounted by smbnetfs.

Kernels of containers often lack the CIFS client; smbnetfs speaks SMB through the same
library as smbclient. It knows no port but the usual one.
"""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

SMBD = shutil.which("smbd") or "/usr/sbin/smbd"
START_LIMIT_S = 20.0

CONFIG = """
[global]
   server role = standalone server
   interfaces = 127.0.0.1
   bind interfaces only = yes
   smb ports = 445
   map to guest = Bad User
   guest account = root
   disable spoolss = yes
   load printers = no
   disable netbios = yes
   pid directory = {root}/run
   lock directory = {root}/run
   state directory = {root}/run
   cache directory = {root}/run
   private dir = {root}/run
   ncalrpc dir = {root}/run/ncalrpc
   log file = {root}/log
[hot]
   path = {share}
   guest ok = yes
   guest only = yes
   read only = no
   strict sync = yes
   force user = root
"""


class Samba:
    """smbd with one share, ``hot``."""

    def __init__(self, root: Path) -> None:
        self.root, self.share = root, root / "share"
        for folder in (self.share, root / "run" / "ncalrpc"):
            folder.mkdir(parents=True)
        config = CONFIG.format(root=root, share=self.share)
        (root / "smb.conf").write_text(config)
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        command = [SMBD, "-F", "--no-process-group", "-s", str(self.root / "smb.conf")]
        self._process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True,
        )  # fmt: skip
        deadline = time.monotonic() + START_LIMIT_S
        while not self._answers():
            if time.monotonic() > deadline or self._process.poll() is not None:
                pytest.skip(f"smbd does not start here: {self._log()}")
            time.sleep(0.05)

    def stop(self) -> None:
        if self._process is not None:
            self._process.terminate()
            self._process.wait(10)

    def run(self, script: str) -> str:
        """What the other program's smbclient says to some commands."""
        command = ["smbclient", "-N", "//127.0.0.1/hot", "-c"]
        done = subprocess.run(
            [*command, script], capture_output=True, text=True, check=False, timeout=60
        )
        return done.stdout + done.stderr

    def _answers(self) -> bool:
        return "NT_STATUS" not in self.run("ls")

    def _log(self) -> str:
        log = self.root / "log"
        return log.read_text(errors="replace")[-500:] if log.exists() else "no log"


@contextmanager
def samba(root: Path) -> Iterator[Samba]:
    """A running server, unless this machine cannot have one."""
    if os.geteuid() != 0:
        pytest.skip("smbd needs root")
    if not Path(SMBD).exists() or shutil.which("smbclient") is None:
        pytest.skip("smbd or smbclient is not installed")
    try:
        socket.create_server(("127.0.0.1", 445)).close()
    except OSError:
        pytest.skip("another SMB server runs here")
    server = Samba(root)
    server.start()
    try:
        yield server
    finally:
        server.stop()


@contextmanager
def mounted(root: Path) -> Iterator[Path]:
    """The share as a folder of this machine, by way of SMB."""
    if shutil.which("smbnetfs") is None:
        pytest.skip("smbnetfs is not installed")
    home, place = root / "home", root / "mnt"
    (home / ".smb").mkdir(parents=True)
    place.mkdir()
    files = {
        "smb.conf": "[global]\n   client min protocol = SMB2\n",
        "smbnetfs.conf": "",
    }
    for name, text in files.items():
        (home / ".smb" / name).write_text(text)
        (home / ".smb" / name).chmod(0o600)
    options = f"config={home}/.smb/smbnetfs.conf"
    environment = {**os.environ, "HOME": str(home)}
    command = ["smbnetfs", str(place), "-o", options]
    subprocess.run(command, env=environment, check=True, timeout=30)
    try:
        yield place / "127.0.0.1" / "hot"
    finally:
        subprocess.run(["umount", "-l", str(place)], check=False)
