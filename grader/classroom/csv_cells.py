"""Cells of a table that a spreadsheet must not take for a formula."""

from sim.support.printable import make_printable

FORMULA = ("=", "+", "-", "@", "\t", "\r")


def escape_formula(text: str) -> str:
    """The text of a cell, with an apostrophe in front if a spreadsheet would take it for a formula.

    Source: OWASP, "CSV Injection".
    """
    text = make_printable(text)
    return f"'{text}" if text.startswith(FORMULA) else text
