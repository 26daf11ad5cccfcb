"""Cells of a table that a spreadsheet must not take for a formula."""

from sim.support.printable import make_printable

FORMULA = ("=", "+", "-", "@", "\t", "\r")


def escape_formula(text: str) -> str:
    """A name that stays a name: one that begins as a formula does gets an apostrophe first.

    Source: OWASP, "CSV Injection".
    """
    text = make_printable(text)
    return f"'{text}" if text.startswith(FORMULA) else text
