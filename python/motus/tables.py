"""What studies find, as tables: rows of the library's structs, for the eye, for a page, and for pandas."""
from __future__ import annotations

import html
import math
from typing import Any, Iterator, Sequence

import numpy as np

from ._motus import ffi
from .errors import text


def plain(value: Any) -> Any:
    """Makes a value of C one of Python, as far as it says by itself what it is."""
    if isinstance(value, ffi.CData):
        return text(value) if ffi.typeof(value).cname in ("char *", "char[]") or "char" in ffi.typeof(value).cname else None
    return value


def row_of(struct: Any, names: Sequence[str]) -> dict[str, Any]:
    return {name: plain(getattr(struct, name)) for name in names}


def shown(value: Any) -> str:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.4g}"
    return "" if value is None else str(value)


class Table:
    """Rows with names.

    Attributes:
        columns: their names.
        rows: a dictionary for each row.
        remarks: what is to be said of them, or "".
    """

    def __init__(self, columns: Sequence[str], rows: list[dict[str, Any]], remarks: str = "", **more: Any) -> None:
        self.columns, self.rows, self.remarks = list(columns), rows, remarks
        self.__dict__.update(more)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def __getitem__(self, name: Any) -> Any:
        """A row by its number or the name of its method, or a column by its name."""
        if isinstance(name, int):
            return self.rows[name]
        if name in self.columns:
            return np.array([row[name] for row in self.rows])
        for row in self.rows:
            if row.get("method") == name:
                return row
        raise KeyError(f"there is no column and no method {name!r}")

    def to_pandas(self) -> Any:
        """Returns a DataFrame of pandas, which must be installed."""
        import pandas

        return pandas.DataFrame(self.rows, columns=self.columns)

    def __str__(self) -> str:
        cells = [self.columns] + [[shown(row[c]) for c in self.columns] for row in self.rows]
        widths = [max(len(line[k]) for line in cells) for k in range(len(self.columns))]
        lines = ["  ".join(f"{cell:{w}}" if k == 0 else f"{cell:>{w}}" for k, (cell, w) in enumerate(zip(line, widths)))
                 for line in cells]
        return "\n".join(line.rstrip() for line in lines) + ("\n\n" + self.remarks if self.remarks else "")

    __repr__ = __str__

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(c)}</th>" for c in self.columns)
        body = "".join("<tr>" + "".join(f"<td>{html.escape(shown(row[c]))}</td>" for c in self.columns) + "</tr>"
                       for row in self.rows)
        remarks = f"<p>{html.escape(self.remarks)}</p>" if self.remarks else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{remarks}"
