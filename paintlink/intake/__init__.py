"""Readings and specifications that arrive as files."""

from paintlink.intake.contract import (
    Certainty,
    Contents,
    Importer,
    ImporterInfo,
    Options,
)
from paintlink.intake.folders import InboxFolders, require_share
from paintlink.intake.inbox import Claim, Inbox, Outcome
from paintlink.intake.mounts import Mount, mount_of
from paintlink.intake.profile import Profile
from paintlink.intake.reading import Import, Item, read_any
from paintlink.intake.registry import importer_failures, importers
from paintlink.intake.safe import BusyFileError
from paintlink.intake.source import Source

__all__ = [
    "BusyFileError",
    "Certainty",
    "Claim",
    "Contents",
    "Import",
    "Importer",
    "ImporterInfo",
    "Inbox",
    "InboxFolders",
    "Item",
    "Mount",
    "Options",
    "Outcome",
    "Profile",
    "Source",
    "importer_failures",
    "importers",
    "mount_of",
    "read_any",
    "require_share",
]
