"""Readings and specifications that arrive as files."""

from paintlink.intake.inbox import Claim, Inbox, InboxFolders, Outcome

__all__ = ["Claim", "Inbox", "InboxFolders", "Outcome"]
