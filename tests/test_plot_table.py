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


@pytest.mark.parametrize(
    ("column", "left"),
    [
        (("quasistatic", "dynamic"), True),
        (("", "dynamic"), True),
        (("0.26 V", "12 V"), False),
        (("−4 %", "+3 %"), False),
        (("–", "0.26 V"), False),
        ((0.26, "none"), False),
        (("", ""), False),
    ],
)
def test_words_stand_on_the_left_and_numbers_on_the_right(column, left):
    table = Table(("which", "what it is"), (("a", column[0]), ("b", column[1])))

    cells = [attrs["style"] for attrs in Tags(table.html).all("td")]
    lines = str(table).splitlines()

    assert all(("text-align:left" in cell) is left for cell in cells)
    assert lines[0] == ("which  what it is")
    assert lines[1].rstrip() == (
        f"a      {column[0]}".rstrip()
        if left
        else f"a      {to_text(column[0]).rjust(10)}".rstrip()
    )


def test_a_table_lines_up_in_a_terminal():
    text = str(Table(("gain", "value"), (("kS", 0.15), ("kV", 12.0)), caption="Gains"))
    assert text.splitlines() == ["Gains", "gain  value", "kS    0.150", "kV     12.0"]
