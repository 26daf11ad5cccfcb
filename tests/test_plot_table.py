"""Tables: three digits, true minus signs, and a header for every row and column."""

import pytest
from html_tags import Tags

from sim.plot import Table
from sim.plot.table import to_text


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        (0.15, "0.150"),
        (2.52384, "2.52"),
        (-0.0921, "−0.0921"),
        (27.01, "27.0"),
        (499, "499"),
        (-3, "−3"),
        (12345.6, "12346"),
        (1.5e7, "1.5e+07"),
        (0.0, "0"),
        (float("inf"), "inf"),
        ("kS", "kS"),
    ],
)
def test_a_cell_has_three_digits(cell, text):
    assert to_text(cell) == text


def test_a_table_names_its_rows_and_columns_for_a_screen_reader():
    tags = Tags(Table(("gain", "value"), (("kS", 0.15), ("<kV>", 2.5)), caption="A & B").html)
    assert [attrs["scope"] for attrs in tags.all("th")] == ["col", "col", "row", "row"]
    html = Table(("gain",), (("<kV>",),), caption="A & B").html
    assert "&lt;kV&gt;" in html
    assert "A &amp; B" in html
