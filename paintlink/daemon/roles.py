"""Roles of the service, and the lock that keeps one process in each."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from paintlink.errors import ConfigError

Role = Literal["intake", "line", "render"]
ROLES: tuple[Role, ...] = ("intake", "line", "render")


class RoleLocks:
    """Holds the roles of this process until it ends, however it ends.

    Raises
    ------
    ConfigError
        When another process on this machine already has one of the roles.
    """

    def __init__(self, folder: Path, roles: Iterable[Role]) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._held: list[int] = []
        for role in roles:
            self._take(folder / f"{role}.lock", role)

    def release(self) -> None:
        """Give the roles back."""
        while self._held:
            os.close(self._held.pop())

    def _take(self, path: Path, role: Role) -> None:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            os.close(descriptor)
            self.release()
            msg = (
                f"another paintlink already runs the {role} role on {path.parent}: "
                "stop it, or use another [state] folder"
            )
            raise ConfigError(msg) from error
        self._held.append(descriptor)
