"""What Java's numbers, texts and collections do, checked against Java 17."""

import math

import pytest

from grader.robotcode.java import collections, lang, streams, text, values
from grader.robotcode.java.values import to_string
from grader.robotcode.library.base import Unknown, WrongArgument

HIGH, LOW = 2**31 - 1, -(2**31)
RESULTS = [
    (values.divide(-7, 2), -3), (values.remainder(-7, 3), -1), (values.divide(-1.0, 0), -math.inf),
    (values.multiply(10**6, 10**6), 10**12), (values.add("x", 1.0), "x1.0"),
    (values.add("n", None), "nnull"), (values.cast("int", 3.99e10), HIGH),
    (values.cast("int", -1e30), LOW), (values.cast("int", math.nan), 0),
    (values.convert("double", 2), 2.0), (values.convert("Double", None), None),
]  # fmt: skip
UNKNOWN = {  # what no robot program needs, so that nobody computes it here
    "a sum that wraps around": values.check_range(values.add(HIGH, 1)),
    "a number beyond 64 bits": values.multiply(2**62, 4),
    "a cast to a byte": values.cast("byte", 300),
    "the number of a character": values.convert("int", "a"),
    "the text of a large number": to_string(1e300),
    "a rare format": text.format("%e", [1.5]),
    "a format of null": text.format("%d", [None]),
    "a method of a text": text.STRING_METHODS["split"]("a,b", ","),
    "an atomic": lang.JAVA["java.util.concurrent.atomic.AtomicInteger"]().get(),
}
FORMATS = {
    "%.2f|%7.3f|%s": ([1.25, 3.14159, "a"], "1.25|  3.142|a"),
    "%d|%5d|%-5s|%s%%": ([42, 42, "x", None], "42|   42|x    |null%"),
}
WRONG_FORMATS = {"%d": [1.5], "%f": [1], "%s": [], "%.1f": [True]}


@pytest.mark.parametrize(("result", "expected"), RESULTS)
def test_arithmetic_gives_the_results_of_java(result, expected):
    assert (result, type(result)) == (expected, type(expected))


@pytest.mark.parametrize("value", UNKNOWN.values(), ids=UNKNOWN)
def test_uncomputable_expression_is_unknown(value):
    assert isinstance(value, Unknown)


def test_code_that_javac_or_java_refuses_is_refused():
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


def test_values_are_equal_as_in_java():
    assert not values.same(math.nan, math.nan)
    assert values.equals([1, "a"], [1, "a"])
    assert not values.equals(1, 1.0)
    assert isinstance(values.same(97, "a"), Unknown)


@pytest.mark.parametrize(("pattern", "case"), FORMATS.items())
def test_string_format_is_that_of_java(pattern, case):
    assert text.format(pattern, case[0]) == case[1]


@pytest.mark.parametrize(("pattern", "given"), WRONG_FORMATS.items())
def test_mismatched_format_strings_are_refused(pattern, given):
    with pytest.raises(text.IllegalFormatException):
        text.format(pattern, given)


def test_collections_and_streams_give_the_results_of_java():
    made = collections.ArrayList(["a", "b", "c"])
    with pytest.raises(
        values.IndexOutOfBoundsException, match="Index 9 out of bounds for length 3"
    ):
        made.get(9)
    squares = streams.IntStream.range(0, 4).map(lambda x: x * x)
    assert squares.average().getAsDouble() == 3.5
    assert made.spliterator().unknown_text == "ArrayList.spliterator()"


def test_collection_changed_by_an_unknown_value_is_unknown():
    counts, numbers = collections.HashMap({"a": 1, "b": 2}), collections.ArrayList([2, 1])
    assert isinstance(counts.merge("a", 1, values.add), Unknown)
    assert isinstance(counts.get("a"), Unknown)
    assert counts.get("b") == 2
    numbers.sort(Unknown("comparing()"))
    assert [type(one) for one in numbers] == [Unknown, Unknown]


def test_more_arguments_than_a_method_has_here_give_something_unknown():
    assert isinstance(lang.JAVA["java.lang.Integer"].valueOf("11", 2), Unknown)
