"""The Java interpreter prints what Java prints, for the programs of ``java_programs/``.

Each text file there holds the programs of one topic; ``java_programs/run_java.py`` describes their
form and writes what Java prints.
"""

from collections import Counter

import pytest
from java_compiler import find_java
from java_main import run_main
from java_programs.run_java import FOLDER, read_programs, run_under_java

PROGRAMS = {
    f"{path.stem}: {program.name}": program
    for path in sorted(FOLDER.glob("*.txt"))
    for program in read_programs(path)
}


@pytest.mark.parametrize("name", sorted(PROGRAMS))
def test_the_interpreter_prints_what_java_prints(name):
    program = PROGRAMS[name]
    assert run_main(program.source).rstrip("\n") == program.prints


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
