"""The Java interpreter prints what Java prints, for the programs of ``java_programs/``.

Each text file there holds the programs of one topic; ``java_programs/run_java.py`` describes their
form and writes what Java prints.
"""

from collections import Counter

import pytest
from java_compiler import find_java
from java_programs.run_java import FOLDER, read_programs, run_under_java

from grader.robotcode import java
from grader.robotcode.library.base import NoSuchMember

PROGRAMS = {
    f"{path.stem}: {program.name}": program
    for path in sorted(FOLDER.glob("*.txt"))
    for program in read_programs(path)
}
# What the interpreter leaves out, because no robot code needs it.
LEFT_OUT = {
    "collections: a collection that contains itself by name",  # a map in itself
    "generics: generic types are erased at run time",  # the check where a generic value is used
    "inheritance: equals with another parameter type is an overload",  # chosen by static types
    "overloading: an overload in the subclass does not override",  # the same
    "strings: equality of string constants and of built strings",  # texts are == by their letters
    "wrappers: bit tricks of Integer and Long",
}


@pytest.mark.parametrize("name", sorted(PROGRAMS.keys() - LEFT_OUT))
def test_the_interpreter_prints_what_java_prints(name):
    program = PROGRAMS[name]
    assert java.run_main(program.source).rstrip("\n") == program.prints


def test_what_is_left_out_is_no_longer_than_it_has_to_be():
    def prints(program):
        try:
            return java.run_main(program.source).rstrip("\n")
        except NoSuchMember:
            return ""

    right = [name for name in LEFT_OUT if prints(PROGRAMS[name]) == PROGRAMS[name].prints]
    assert right == []


def test_each_program_has_a_name_of_its_own_and_prints_something():
    names = [one.name for path in FOLDER.glob("*.txt") for one in read_programs(path)]
    assert len(names) > 260
    assert [name for name, count in Counter(names).items() if count > 1] == []
    assert [name for name, program in PROGRAMS.items() if not program.prints] == []


@pytest.mark.slow
def test_java_prints_what_the_programs_say():
    printed = run_under_java(list(PROGRAMS.values()), java=find_java())
    expected = {name: program.prints for name, program in PROGRAMS.items()}
    assert dict(zip(PROGRAMS, printed, strict=True)) == expected
