"""Where the configuration file may lie, and the folders it does not have to name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

SYSTEM_FILE = Path("/etc/paintlink/paintlink.toml")


def candidates() -> Iterator[Path]:
    """Files to look for when nobody names one; the first that exists is used."""
    yield SYSTEM_FILE
    from platformdirs import user_config_path

    yield user_config_path("paintlink") / SYSTEM_FILE.name


def is_absent(path: Path) -> bool:
    """Whether nothing is there; what cannot be looked at counts as there."""
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return True
    except OSError:
        return False
    return False


def state_folder(environ: Mapping[str, str]) -> Path:
    """Folder for what is remembered: systemd's if it gives one, else the user's."""
    given = _systemd_folder(environ)
    if given is not None:
        return given
    from platformdirs import user_state_path

    return user_state_path("paintlink")


def site_folder(environ: Mapping[str, str]) -> Path:
    """Folder that files pass through when the configuration names none."""
    given = _systemd_folder(environ)
    if given is not None:
        return given / "site"
    from platformdirs import user_data_path

    return user_data_path("paintlink") / "site"


def inbox_folder(site: Path) -> Path:
    """Folder that is watched for colour files when the configuration names none."""
    return site / "inbox"


def _systemd_folder(environ: Mapping[str, str]) -> Path | None:
    first = environ.get("STATE_DIRECTORY", "").partition(":")[0]
    return Path(first) if first else None
