"""What Java's numbers, texts and collections do, checked against Java 17."""

import math

import pytest

from grader.robotcode.java import collections, lang, streams, text, values
from grader.robotcode.java.values import Byte, Char, Float, Long, Short, to_string
from grader.robotcode.library.base import Unknown, WrongArgument

HIGH, LOW = 2**31 - 1, -(2**31)
TEXTS = {
    0.0: "0.0", 1e7: "1.0E7", 9999999.0: "9999999.0", 1e-3: "0.001", 9.99e-4: "9.99E-4",
    12345678.9: "1.23456789E7", 1 / 3: "0.3333333333333333", 5e-324: "4.9E-324",
    math.inf: "Infinity", Float(0.1): "0.1", Float(1 / 3): "0.33333334", Float(1.4e-45): "1.4E-45",
}  # fmt: skip
RESULTS = [
    (values.add(HIGH, 1), LOW), (values.multiply(10**6, 10**6), -727379968),
    (values.multiply(10**6, Long(10**6)), Long(10**12)), (values.negate(LOW), LOW),
    (values.divide(-7, 2), -3), (values.remainder(-7, 3), -1), (values.divide(LOW, -1), LOW),
    (values.divide(-1.0, 0), -math.inf), (values.shift_left(1, 33), 2),
    (values.shift_unsigned(-17, 28), 15), (values.shift_left(Long(1), 33), Long(2**33)),
    (values.add(Char("a"), 1), 98), (values.add("a", Char("b")), "ab"),
    (values.add("x", 1.0), "x1.0"), (values.add("n", None), "nnull"),
    (values.add(Float(1), 0.1), 1.1), (values.cast("int", 3.99e10), HIGH),
    (values.cast("int", math.nan), 0), (values.cast("byte", 300.7), Byte(44)),
    (values.cast("char", 65.7), Char("A")), (values.cast("short", 70000), Short(4464)),
    (values.convert("double", 2), 2.0), (values.convert("Double", None), None),
    (values.convert("int", Char("a")), 97),
]  # fmt: skip
FORMATS = {
    "%.2f|%7.3f|%08.2f|%,.0f": ([1.005, 3.14159, -3.14159, 1234.56], "1.01|  3.142|-0003.14|1,235"),
    "%d|%5d|%-5d|%05d|%+d": ([42, 42, 42, -42, 5], "42|   42|42   |-0042|+5"),
    "%e|%x|%c|%b|%.1s%%": ([1.5, -1, Char("x"), None, "cut"], "1.500000e+00|ffffffff|x|false|c%"),
}  # fmt: skip
WRONG_FORMATS = {
    "%d": ([1.5], "d != java.lang.Double"), "%f": ([1], "f != java.lang.Integer"),
    "%s": ([], "Format specifier '%s'"), "5%": ([], "Conversion = '%'"),
}  # fmt: skip


@pytest.mark.parametrize(("value", "written"), TEXTS.items())
def test_a_number_is_written_as_java_writes_it(value, written):
    assert to_string(value) == written


@pytest.mark.parametrize(("result", "expected"), RESULTS)
def test_arithmetic_is_java_s(result, expected):
    assert (result, type(result)) == (expected, type(expected))


def test_what_javac_or_java_refuses_is_refused():
    with pytest.raises(WrongArgument, match="needs a cast"):
        values.convert("int", 2.5)
    with pytest.raises(values.NullPointerException):
        values.convert("int", None)
    with pytest.raises(values.ArithmeticException, match="ArithmeticException: / by zero"):
        values.remainder(1, 0)


def test_result_of_an_unknown_value_is_unknown():
    unknown = Unknown("speed")
    assert values.add(unknown, 1) is values.less(2.0, unknown) is unknown
    assert values.same(unknown, None) is text.format("%.2f", [unknown]) is unknown
    assert lang.JAVA["java.lang.Math"].max(1.0, unknown) is unknown
    assert text.STRING_METHODS["contains"]("abc", unknown) is unknown


def test_equality_of_values():
    assert values.same(97, Char("a"))
    assert not values.same(math.nan, math.nan)
    assert values.equals(math.nan, math.nan)
    assert not values.equals(1, Long(1))
    assert not values.equals(Char("a"), "a")
    assert values.hash_code("hello") == 99162322


@pytest.mark.parametrize(("pattern", "case"), FORMATS.items())
def test_string_format_is_that_of_java(pattern, case):
    assert text.format(pattern, case[0]) == case[1]


@pytest.mark.parametrize(("pattern", "case"), WRONG_FORMATS.items())
def test_formats_that_do_not_fit(pattern, case):
    with pytest.raises(text.IllegalFormatException) as caught:
        text.format(pattern, case[0])
    assert caught.value.getMessage() == case[1]


def test_collections_and_streams():
    made = collections.ArrayList(["a", "b", "c"])
    with pytest.raises(
        values.IndexOutOfBoundsException, match="Index 9 out of bounds for length 3"
    ):
        made.get(9)
    squares = streams.IntStream.range(0, 4).map(lambda x: x * x)
    assert to_string(squares.average()) == "OptionalDouble[3.5]"
    assert made.spliterator().unknown_text == "ArrayList.spliterator()"


def test_more_arguments_than_a_method_has_here_give_something_unknown():
    assert isinstance(text.STRING_METHODS["lastIndexOf"]("abc", "b"), int)
    assert isinstance(lang.JAVA["java.lang.Integer"].parseInt("11", 2), Unknown)
