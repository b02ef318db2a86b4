"""Primes with their variants, as a colour book groups them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from paintbook import draw
from paintbook.colours import Paints, joined, paints
from paintbook.roles import NO_ROLE, roles
from paintbook.shelf import Shelf

RELATIVES = 48
BETWEEN_PAINTS = 1.0
"""Least difference between any two paints in one of nine Lab values."""
GROUP_SIZES = np.array([1, 2, 3, 4, 5, 6])
SIZE_SHARES = np.array([0.24, 0.22, 0.22, 0.16, 0.10, 0.06])

Allowed = Callable[[Paints], NDArray[np.bool_]]


@dataclass(slots=True)
class Group:
    """A prime and its variants by role; members are rows of some `Paints`.

    ``spare`` are variants that would also fit, role and row.
    """

    prime: int
    variants: dict[int, int] = field(default_factory=dict)
    spare: list[tuple[int, int]] = field(default_factory=list)

    def members(self) -> Iterator[tuple[int, int]]:
        """Role and row of each, the prime first."""
        yield 0, self.prime
        yield from sorted(self.variants.items())

    def moved(self, rows: int) -> Group:
        """The same group where its paints stand so many rows further down."""
        variants = {role: row + rows for role, row in self.variants.items()}
        return Group(self.prime + rows, variants)


def sizes(total: int, rng: np.random.Generator) -> list[int]:
    """Sizes of groups that hold so many paints together."""
    drawn = rng.choice(GROUP_SIZES, total, p=SIZE_SHARES)
    count = int(np.searchsorted(np.cumsum(drawn), total)) + 1
    found: list[int] = drawn[:count].tolist()
    found[-1] -= sum(found) - total
    return found


def grown(
    primes: Paints,
    wanted: list[int],
    shelf: Shelf,
    allowed: Allowed,
    rng: np.random.Generator,
) -> tuple[Paints, list[Group]]:
    """Primes and all relatives as one set of paints, and the groups formed of them.

    A group stays smaller than wanted where too few relatives look different in a way
    that has a word.
    """
    family = draw.relatives(primes.parts, RELATIVES, rng)
    relatives = paints(family.reshape(-1, family.shape[-1]))
    looks = _looks(primes, relatives, allowed)
    everything = joined(primes, relatives)
    travel = everything.travel()
    groups = []
    for prime, size in enumerate(wanted):
        group = Group(prime)
        first = len(primes) + prime * RELATIVES
        for row, role in enumerate(looks[prime].tolist(), start=first):
            if role == NO_ROLE:
                continue
            wanted_still = len(group.variants) < size - 1 and role not in group.variants
            if wanted_still and shelf.room(travel[row], BETWEEN_PAINTS):
                group.variants[role] = row
                shelf.put(travel[row])
            else:
                group.spare.append((role, row))
        groups.append(group)
    return everything, groups


def _looks(primes: Paints, relatives: Paints, allowed: Allowed) -> NDArray[np.int64]:
    """Role of each relative, `NO_ROLE` for those that cannot enter, shape (n, r)."""
    shape = (len(primes), RELATIVES)
    travel = relatives.travel().reshape(*shape, 3, 3)
    found = roles(travel, primes.travel())
    stays = relatives.leaf.reshape(shape) == primes.leaf[:, np.newaxis]
    # A relative of a metallic must not have become a pearl, or the other way round.
    stays &= relatives.pearl.reshape(shape) == primes.pearl[:, np.newaxis]
    return np.where(stays & allowed(relatives).reshape(shape), found, NO_ROLE)
