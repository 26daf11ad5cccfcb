"""The four tests by kind and direction, and where they are bound."""

from collections.abc import Iterable

from grader.robotcode.binding_facts import DIRECTIONS, KINDS, BindingFacts, SysIdTest

Test = tuple[str, str]  # kind and direction

TESTS = frozenset((kind, way) for kind in KINDS for way in DIRECTIONS)


def all_of(tests: Iterable[SysIdTest]) -> frozenset[Test]:
    """Tests by kind and direction; one whose direction a parameter decides is both."""
    found = set()
    for one in tests:
        ways = DIRECTIONS if one.direction == "any" else (one.direction,)
        found |= {(one.kind, way) for way in ways if way}
    return frozenset(found)


def missing(facts: BindingFacts) -> frozenset[Test]:
    """The tests that no button runs."""
    return TESTS - all_of(test for one in facts.bindings for test in one.tests)


def times(facts: BindingFacts, test: Test) -> list[int]:
    """The lines where a test is bound."""
    return sorted(one.line for one in facts.bindings if test in all_of(one.tests))


def named(tests: Iterable[Test]) -> str:
    """Tests in words, in the order they are run: ``quasistatic reverse and dynamic forward``."""
    order = [(kind, way) for kind in KINDS for way in DIRECTIONS]
    return " and ".join(" ".join(one) for one in sorted(tests, key=order.index))
