"""What a person reads of each command, word for word, in one file a command: ``tests/snapshots/``.

How to write them anew stands in ``wording.py``. What a command finds, and its numbers, are tested
elsewhere: digits count here only where a story was made by hand.
"""

import io
import re
from dataclasses import replace

import numpy as np
from rich.console import Console
from story_made import PLACE, REMAINS, SAG, SLIP, STORIES, story
from wording import FOLDER, compare, read_parts

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.inspect.contaminate import contaminate
from sim.inspect.faults import FAULTS
from sim.reconcile.story_text import list_inspections, list_next_tests, write_headline
from sim.reconcile.verdict import CUT_SHORT
from sim.report.story_terminal import show_story
from sim.support.command_line import run_command

NUMBER = re.compile(r"\d+(?:[.,]\d+)*(?:e[+-]?\d+)?")


def told(one):
    """What a terminal of eighty columns shows of a story."""
    out = io.StringIO()
    show_story(one, title="drive.csv", console=Console(file=out, width=80, highlight=False))
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines())


def run(capsys, *words):
    """What a command prints, its numbers left out and its lines joined: they break by length."""
    run_command(sysid, name="sysid", arguments=[*map(str, words)])
    return re.sub(r" +", " ", NUMBER.sub("#", capsys.readouterr().out.replace("\n", " ")))


def test_sentences_of_reconcile_equal_the_snapshot():
    off, unsure = STORIES["nothing missing"], STORIES["ambiguous"].findings[0]
    one = STORIES["explained"]
    stories = STORIES | {
        "stopped": replace(STORIES["unexplained"], complete=False, remains=CUT_SHORT),
        "stopped after drag": replace(one, complete=False, remainder=True, remains=CUT_SHORT),
        "perhaps damaged": story(
            SLIP, replace(SLIP, effect="hard-stop", probability=0.7), chapters=1
        ),
        "far off": replace(off, gap_after=3.0 * off.noise_floor),
        "all at once": story(
            SLIP, *STORIES["ambiguous"].findings, SAG, verdict="ambiguous", **REMAINS
        ),
    }
    parts = {name: write_headline(each) for name, each in stories.items()}
    whole = {f"{name}, on a terminal": told(stories[name]) for name in ("stopped", "all at once")}
    places = [replace(PLACE, error=error).sentence for error in (0.9614, -99.4, 123.4)]
    looks = [f"{what}: {how}" for found in (unsure, SLIP) for what, how in list_inspections(found)]

    compare(
        "reconcile",
        parts
        | whole
        | {
            "places": "\n".join(places),
            "what to look at": "\n".join(looks),
            "tests to run next": "\n".join(list_next_tests(story(unsure, unsure))),
        },
    )


def test_sentences_about_the_gap_equal_the_snapshot():
    sizes = {
        f"velocity, {error:+g} noises": replace(PLACE, error=error).sentence
        for error in (-2.0, 2.0)
    }

    compare("gap", sizes)


def test_sentences_of_inspect_equal_the_snapshot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    log = simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(4))
    parts = {}
    for name in ["no fault", *FAULTS]:
        damaged = log
        if name != "no fault":
            damaged = contaminate(log, name, severity=2.0, rng=np.random.default_rng(7)).log
        sim.write(damaged, "log.csv")
        parts[name] = run(capsys, "inspect", "log.csv")

    compare("inspect", parts)


def test_sentences_of_fit_equal_the_snapshot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    parts = {}
    for name in ("drivetrain", "elevator", "arm"):
        sim.write(simulate(MECHANISMS[name], Routine(), rng=np.random.default_rng(2)), "log.csv")
        parts[name] = run(capsys, "fit", "log.csv", "--type", MECHANISMS[name].type)

    compare("fit", parts)


def test_every_snapshot_belongs_to_a_test():
    for path in sorted(FOLDER.glob("test_*.txt")):
        source = path.parents[1] / f"{path.stem}.py"
        tests = re.findall(r"^def (test_\w+)", source.read_text(encoding="utf-8"), re.MULTILINE)
        titles = read_parts(path.stem)

        assert titles, path
        assert {re.split(r"[\[,]", title)[0] for title in titles} <= set(tests), path
