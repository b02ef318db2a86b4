"""A stand-in for formulation software (ColorNet), for the virtual paint system.

It knows the toners at their nominal strengths, not those of the cans in a booth.
"""

from paintlink_simulators.colornet.correction import Attempt, best_attempt, correct
from paintlink_simulators.colornet.formulation import (
    Formulation,
    adjusted,
    formulate,
)
from paintlink_simulators.colornet.known import BundledBook
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.colornet.watch import Book, Watch

__all__ = [
    "Attempt",
    "Book",
    "BundledBook",
    "Formulation",
    "Target",
    "Watch",
    "adjusted",
    "best_attempt",
    "correct",
    "formulate",
]
