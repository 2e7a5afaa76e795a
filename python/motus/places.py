"""Where the numbers of a system stand: names of columns, and the shapes of vectors and families."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ._motus import ffi, lib
from .calls import check, new, new_error
from .errors import text


class Place(NamedTuple):
    """The columns that a name stands for: `count` of them from `first` on, in the order of an array of `shape`."""

    first: int
    count: int
    shape: tuple[int, ...]


def column(system: Any, k: int) -> Any:
    made = new("column")
    if lib.motus_column_at(system, k, made) != lib.MOTUS_OK:
        raise IndexError(f"there is no column {k}")
    return made


def column_name(system: Any, k: int) -> str:
    return text(column(system, k).name)


def find(system: Any, name: str) -> Place:
    """Finds the columns that a name stands for. Raises :class:`motus.UnknownNameError`."""
    first, count, err = ffi.new("size_t *"), ffi.new("size_t *"), new_error()
    check(lib.motus_column_find(system, name.encode(), first, count, err), err)
    if count[0] == 1:
        return Place(first[0], 1, ())
    a, b = column(system, first[0]), column(system, first[0] + count[0] - 1)
    shape = [b.cell[d] - a.cell[d] + 1 for d in range(a.dimensions)]
    if b.component > a.component:
        shape.append(b.component - a.component + 1)
    whole = int(np.prod(shape, dtype=int)) == count[0]  # a family may lack cells
    return Place(first[0], count[0], tuple(shape) if whole else (count[0],))


def shaped(array: np.ndarray, place: Place) -> np.ndarray:
    """Returns the numbers of a place in the rows of a table, as a view of it."""
    part = array[..., place.first : place.first + place.count]
    return part[..., 0] if place.shape == () else part.reshape(*array.shape[:-1], *place.shape)
