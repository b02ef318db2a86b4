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
from paintlink.intake.order_file import Order, read_order
from paintlink.intake.profile import Profile
from paintlink.intake.profile_file import load_profile, load_profiles
from paintlink.intake.reading import Import, Item, read_any, read_colours
from paintlink.intake.registry import importer_failures, importers
from paintlink.intake.safe import BusyFileError
from paintlink.intake.source import Source, open_source
from paintlink.intake.vin import vin_problem
from paintlink.intake.wizard import Proposal, propose

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
    "Order",
    "Outcome",
    "Profile",
    "Proposal",
    "Source",
    "importer_failures",
    "importers",
    "load_profile",
    "load_profiles",
    "mount_of",
    "open_source",
    "propose",
    "read_any",
    "read_colours",
    "read_order",
    "require_share",
    "vin_problem",
]
