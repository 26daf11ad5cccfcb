"""The authored ways of ``solutions/``: what a learner who does everything right would hand in."""

import importlib.util
from functools import cache
from pathlib import Path

from grader.exercise import Exercise

ROOT = Path(__file__).resolve().parents[1]


@cache
def load(path: Path):
    """A file of ``solutions/`` as a module."""
    spec = importlib.util.spec_from_file_location(f"_{path.parent.name}_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def mistakes_of(name: str):
    """The planted mistakes of an exercise."""
    return load(ROOT / "solutions" / name / "mistakes.py").MISTAKES


def authored_answer(one: Exercise, data: Path) -> dict[str, str]:
    """File name -> text of the right answer to an exercise.

    Args:
        one: the exercise, with the files to fill in.
        data: the learner's own data, drawn before.
    """
    folder = ROOT / "solutions" / one.name
    if (folder / "solve.py").is_file():
        return load(folder / "solve.py").solve(one.folder, data)
    return {
        name: (folder / name).read_text(encoding="utf-8")
        for name in (*one.files, *one.companion_files)
    }
