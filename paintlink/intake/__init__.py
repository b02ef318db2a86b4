"""Readings and specifications that arrive as files."""

from paintlink.intake.inbox import Claim, Inbox, InboxFolders, Outcome
from paintlink.intake.mounts import Mount, mount_of

__all__ = ["Claim", "Inbox", "InboxFolders", "Mount", "Outcome", "mount_of"]
