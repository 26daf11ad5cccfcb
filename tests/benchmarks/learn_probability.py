"""Learn how likely a finding of ``sysid reconcile`` is right, from cases with a known truth.

    python tests/benchmarks/learn_probability.py solve FOLDER ROWS.jsonl [--part 0/2]
    python tests/benchmarks/learn_probability.py learn ROWS.jsonl [ROWS.jsonl …] [--write]

``solve`` takes a folder of cases with its ``key.json``, as ``bench_reconcile.py --keep`` leaves
them, and writes one line for each: what is hidden, what was found, and the evidence of every effect
of the last model. It goes on where it was stopped. ``learn`` takes such files, one for each maker
of cases, fits a logistic regression, and reports every maker left out once. ``--write`` stores the
coefficients in ``sim/reconcile/probability.json`` and draws ``reliability.svg``. It needs
scikit-learn, which nothing else of the course does.
"""

import argparse
import json
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import sim
from sim.cli.open.reconcile_job import inspect_damage
from sim.core.errors import BadRequest
from sim.physics.effects import find_motion_class
from sim.reconcile import reconcile
from sim.reconcile.probability import FEATURES, FILE

HERE = Path(__file__).resolve().parent
LOGS = {"log": "train", "validation": "validation", "held_out": "test"}
BINS = np.linspace(0.0, 1.0, 11)
SURE = 0.9  # from which at least as many of the findings have to be right

Rows = Sequence[tuple[tuple[float, ...], bool]]  # features, and whether the effect is right


def solve_folder(folder: Path, rows: Path, *, part: int, parts: int) -> None:
    """Solve the cases of a folder that are not in a file of rows yet, and add them.

    Args:
        folder: of cases, with ``key.json``.
        rows: file to add to.
        part: which cases, of ``parts``.
        parts: how many processes share the work.
    """
    key = json.loads((folder / "key.json").read_text(encoding="utf-8"))
    there = rows.read_text(encoding="utf-8").splitlines() if rows.exists() else []
    known = {json.loads(line)["case"] for line in there}
    with rows.open("a", encoding="utf-8") as out:
        for number, (case, truth) in enumerate(key.items()):
            if number % parts == part and case not in known and not truth.get("shuffled"):
                row = {"case": case, "truth": truth, **_solve(folder / case)}
                out.write(json.dumps(row) + "\n")
                out.flush()


def _solve(case: Path) -> Mapping[str, Any]:
    told = json.loads((case / "case.json").read_text(encoding="utf-8"))
    began = time.process_time()
    try:
        logs = {
            name: sim.read(case / f"{file}.csv", type=told["type"]) for name, file in LOGS.items()
        }
        damages = {name: inspect_damage(log) for name, log in logs.items()}
        story = reconcile(
            **logs, type=told["type"], travel=told.get("travel"), damages=damages,
        )  # fmt: skip
    except BadRequest as refusal:
        return {"refused": str(refusal)}
    return {
        "verdict": story.verdict,
        "remainder": story.remainder,
        "gaps": [story.gap_before, story.gap_after, story.noise_floor],
        "findings": [
            {name: asdict(one)[name] for name in ("effect", "size", "probability")}
            for one in story.findings
        ],
        "judged": [asdict(one) for one in story.judged],
        "seconds": time.process_time() - began,
    }


def read_rows(path: Path) -> Rows:
    """The judged effects of a file that ``solve`` made.

    Args:
        path: of it.
    """
    found = []
    for line in path.read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        hidden = {find_motion_class(name) for name in row["truth"]["effects"]}
        for one in row.get("judged", ()):
            named = {find_motion_class(name) for name in (one["effect"], *one["ambiguous_with"])}
            features = tuple(one["evidence"][name] for name in FEATURES)
            found.append((features, bool(named & hidden)))
    return found


def fit_coefficients(rows: Rows) -> dict[str, float]:
    """Intercept and coefficients of a logistic regression, of features as they are.

    Args:
        rows: to learn from.
    """
    from sklearn.linear_model import (  # type: ignore[import-untyped]  # noqa: PLC0415 - optional
        LogisticRegression,
    )

    table, right = _arrays(rows)
    mean, scale = table.mean(axis=0), table.std(axis=0)
    scale[scale == 0.0] = 1.0  # one prior for all, whatever their units
    model = LogisticRegression(C=1.0).fit((table - mean) / scale, right)
    weights = model.coef_[0] / scale
    fitted = dict(zip(FEATURES, map(float, weights), strict=True))
    return {"intercept": float(model.intercept_[0] - weights @ mean), **fitted}


def predict(rows: Rows, coefficients: Mapping[str, float]) -> NDArray[np.float64]:
    """(n,) The probability of each row."""
    table, _ = _arrays(rows)
    weights = np.array([coefficients[name] for name in FEATURES])
    return np.asarray(1.0 / (1.0 + np.exp(-(coefficients["intercept"] + table @ weights))))


def describe_calibration(told: NDArray[np.float64], rows: Rows) -> str:
    """One line: how often what was told with a probability is right."""
    _, right = _arrays(rows)
    sure = told >= SURE
    bins = np.clip(np.digitize(told, BINS) - 1, 0, len(BINS) - 2)
    error = sum(
        abs(float(np.sum(told[bins == one] - right[bins == one]))) for one in np.unique(bins)
    ) / len(told)
    likely = told >= 0.5
    return (
        f"{len(told)} effects, {right.mean():.0%} right; of {sure.sum()} told with {SURE:.0%} and "
        f"more {right[sure].mean():.1%} are right; of {likely.sum()} told at all "
        f"{right[likely].mean():.1%}; expected calibration error {error:.3f}"
    )


def learn(files: Sequence[Path], *, write: bool) -> None:
    """Fit all files, report each of them left out once, and store the result if asked.

    Args:
        files: rows, one file for each maker of cases.
        write: whether to store the coefficients and the diagram.
    """
    makers = {file.stem: read_rows(file) for file in files}
    left_out: dict[str, NDArray[np.float64]] = {}
    for name, rows in makers.items():
        others = [row for other, some in makers.items() if other != name for row in some]
        if others:
            left_out[name] = predict(rows, fit_coefficients(others))
            print(f"{name} left out: {describe_calibration(left_out[name], rows)}")
    every = [row for rows in makers.values() for row in rows]
    fitted = fit_coefficients(every)
    print(f"all: {describe_calibration(predict(every, fitted), every)}")
    print(json.dumps(fitted, indent=1))
    if write:
        counts = {name: len(rows) for name, rows in makers.items()}
        stored = {"learnt_from": counts, "coefficients": fitted}
        FILE.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
        draw_reliability(left_out, makers)


def draw_reliability(told: Mapping[str, NDArray[np.float64]], makers: Mapping[str, Rows]) -> None:
    """Draw how often findings are right over the probability they were told with.

    Args:
        told: maker -> (n,) probabilities, learnt from the others.
        makers: maker -> its rows.
    """
    from matplotlib.figure import Figure  # noqa: PLC0415 - only for the diagram

    figure = Figure(figsize=(5.0, 5.0), layout="constrained")
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=1, label="what is told is so")
    for name, rows in makers.items():
        if name not in told:
            continue
        _, right = _arrays(rows)
        bins = np.clip(np.digitize(told[name], BINS[::2]) - 1, 0, len(BINS[::2]) - 2)
        points = [
            (told[name][bins == one].mean(), right[bins == one].mean(), int((bins == one).sum()))
            for one in np.unique(bins)
        ]
        x, y, n = map(np.array, zip(*points, strict=True))
        error = np.sqrt(np.maximum(y * (1 - y), 0.02) / n)
        axes.errorbar(x, y, error, marker="o", capsize=2, label=f"{name}, left out")
    axes.set(xlabel="probability told", ylabel="share that is right", xlim=(0, 1), ylim=(0, 1.02))
    axes.legend(loc="upper left")
    figure.savefig(HERE / "reliability.svg", metadata={"Date": None})


def _arrays(rows: Rows) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    return np.array([row for row, _ in rows]), np.array([right for _, right in rows])


def main() -> None:
    """Solve cases, or learn from them."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    jobs = parser.add_subparsers(dest="job", required=True)
    solver = jobs.add_parser("solve")
    solver.add_argument("folder", type=Path)
    solver.add_argument("rows", type=Path)
    solver.add_argument("--part", default="0/1", help="Of the work: 0/2 and 1/2 share it.")
    learner = jobs.add_parser("learn")
    learner.add_argument("rows", type=Path, nargs="+")
    learner.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    if asked.job == "solve":
        part, parts = map(int, asked.part.split("/"))
        solve_folder(asked.folder, asked.rows, part=part, parts=parts)
        return
    if find_spec("sklearn") is None:
        sys.exit("scikit-learn is not installed. Run: python -m pip install scikit-learn")
    learn(asked.rows, write=asked.write)


if __name__ == "__main__":
    main()
