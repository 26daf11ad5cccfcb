"""The verdict: what the findings and what is left of the gap come to."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from reconcile_made import recorded
from story_made import DRAG, SLIP

from sim.core.log import Log
from sim.core.units import find_unit
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.engine import State
from sim.physics.model import Model
from sim.reconcile.candidates import score_estimate
from sim.reconcile.cross_validation import Gap
from sim.reconcile.findings import make_findings
from sim.reconcile.judgement import judge_effects
from sim.reconcile.remarks import list_remarks, select_reported_rounds
from sim.reconcile.residual_tests.repeatability import RepeatedResidual
from sim.reconcile.residual_tests.spectrum import SpectralPeak
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.residual_tests.whiteness import WorstWindow
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.story import TriedCandidate
from sim.reconcile.thresholds import LEAST_PROBABILITY
from sim.reconcile.verdict import reach_verdict

GAINS = {"kS": 0.2, "kV": 0.5, "kA": 0.05}
SURELY = 1e5  # [of -2 log L] that an effect is worth
METERS = find_unit("meters")
LASTS = 1e6  # [s]


@pytest.fixture(scope="module")
def problem():
    """Two steps, whose velocities have a noise of 8 mm/s beside 11 m/s."""
    rng = np.random.default_rng(3)
    model = Model("simple", GAINS)
    runs = [
        recorded(test, model, step=6.0, state=State.cold_at(0.0), noise=(1e-5, 0.008), rng=rng)
        for test in ("dynamic-forward", "dynamic-reverse")
    ]
    return PredictionErrorProblem.from_records(
        make_run_records(Log(tuple(runs), units="meters", type="simple"))
    )


def with_tried(one, reports):
    """The round, with what was tried on top of it."""
    weighed = [WeighedCandidate(one.candidate, one.gap, report) for report in reports]
    return replace(one, candidates=tuple(weighed))


def rounds(problem, *gaps, values=GAINS, structure=None):
    """The base and what was added to it, with gaps in noises of the velocity."""
    structure = structure or ModelStructure("simple")
    point = problem.evaluate(
        structure, values, RunNuisance.at_first_samples(2), problem.noise.velocity**2
    )
    sizes = [Gap(gap * problem.noise.velocity, 1e-5) for gap in gaps]
    before = [sizes[0], *sizes[:-1]]
    found = score_estimate(problem, point)
    return [
        SelectionRound(found, gap, found, without)
        for gap, without in zip(sizes, before, strict=True)
    ]


@pytest.mark.parametrize(
    ("gaps", "findings", "verdict", "remains"),
    [
        ((40.0, 1.1), [DRAG], "explained", False),
        ((40.0, 15.0), [DRAG], "explained", True),  # less than half is left
        ((40.0, 30.0), [DRAG], "unexplained", True),
        ((2.0, 1.6), [DRAG], "explained", False),  # next to nothing
        ((40.0,), [SLIP], "explained", True),  # damage narrows no gap
        ((40.0, 30.0), [SLIP, DRAG], "unexplained", True),
        ((60.0,), [], "unexplained", True),
    ],
)
def test_effect_that_leaves_most_of_the_gap_is_no_explanation(
    problem, gaps, findings, verdict, remains
):
    said = reach_verdict(
        findings, rounds(problem, *gaps), problem, residuals=ResidualSummary(), unit=METERS
    )

    assert said[:2] == (verdict, remains)
    assert bool(said[2]) is remains


def added(problem, *steps, values):
    """The base and each effect with the gap it left, and the gap without it in the end [noises]."""
    structure = ModelStructure("simple", tuple(name for name, *_ in steps))
    point = problem.evaluate(
        structure, values, RunNuisance.at_first_samples(2), problem.noise.velocity**2
    )
    gaps = [Gap(size * problem.noise.velocity, 1e-5) for size in (2.0, *(one[1] for one in steps))]
    base = score_estimate(problem, point)
    bare = replace(base, bic=base.bic + SURELY)
    return [
        SelectionRound.make_base(base, gaps[0]),
        *(
            SelectionRound(
                replace(base, effect=name), gap, bare, Gap(without * problem.noise.velocity, 1e-5)
            )
            for (name, _, without), gap in zip(steps, gaps[1:], strict=True)
        ),
    ]


def find_effects(problem, done, *, residuals):
    """The findings, where the shown log is missed as the other runs are."""
    chapters = [SimpleNamespace(gap=one.gap.velocity) for one in done]
    without = {one.candidate.effect: one.gap_without.velocity for one in done[1:]}
    return make_findings(
        problem,
        done,
        [],
        chapters,
        without=without,
        residuals=residuals,
        unit=METERS,
    )[0]


@pytest.mark.parametrize(
    ("steps", "sizes"),
    [
        # either alone would do nearly as well: the first closed the gap
        ([("drag", 1.1, 1.05), ("spring", 1.0, 1.1)], {"drag": "major", "spring": "minor"}),
        ([("drag", 1.9, 1.1), ("spring", 1.0, 1.1)], {"drag": "minor", "spring": "major"}),
        # each is missed alone
        ([("drag", 1.4, 1.5), ("spring", 1.0, 1.4)], {"drag": "major", "spring": "major"}),
        # together they close next to nothing
        ([("drag", 1.95, 1.85), ("spring", 1.8, 1.85)], {"drag": "minor", "spring": "minor"}),
    ],
)
def test_interchangeable_effect_that_closed_the_gap_is_major(problem, steps, sizes):
    values = {**GAINS, "drag.drag": 0.03, "spring.rate": 0.1, "spring.preload": 0.1}
    done = added(problem, *steps, values=values)

    found = find_effects(problem, done, residuals=ResidualSummary())

    assert {one.effect: one.size for one in found} == sizes


@pytest.mark.parametrize(
    ("shown", "size"), [(1.9, "major"), (1.0, "minor"), (0.99, None), (0.9, None)]
)
def test_effect_that_widens_the_shown_gap_is_not_reported(problem, shown, size):
    values = {**GAINS, "drag.drag": 0.03}
    done = added(problem, ("drag", 1.0, 2.0), values=values)
    end = done[-1].gap.velocity
    chapters = [SimpleNamespace(gap=2.0 * end), SimpleNamespace(gap=end)]

    found, _, refuted = make_findings(
        problem, done, [], chapters, without={"drag": shown * end}, residuals=ResidualSummary(),
        unit=METERS,
    )  # fmt: skip
    verdict = reach_verdict(
        found, done, problem, residuals=ResidualSummary(), refuted=refuted, unit=METERS
    )

    assert [one.size for one in found] == [size] * (size is not None)
    assert refuted == ("drag",) * (size is None)
    assert ("misses runs that were not fitted by more" in verdict[2]) is (size is None)


@pytest.mark.parametrize(
    ("onset", "until", "judged"),
    [
        (0.5, LASTS, True),
        (0.5, 1.0, True),
        (0.0, LASTS, False),  # in all runs, as kA
        (1e3, LASTS, False),  # after the last run
        (0.5, 0.5, False),
    ],
)
def test_an_inertia_that_changes_while_nothing_is_recorded_is_no_finding(
    problem, onset, until, judged
):
    change = {"extra": 0.03, "onset": onset, "until": until, "shared": 0.0}
    values = {**GAINS, **{f"inertia-change.{name}": value for name, value in change.items()}}
    done = added(problem, ("inertia-change", 1.0, 2.0), values=values)

    found = judge_effects(problem, done, ResidualSummary(), damaged=False)

    assert [one.effect for one in found] == ["inertia-change"] * judged


@pytest.mark.parametrize(("steps", "judged"), [(0.5, False), (-0.5, False), (2.0, True)])
def test_a_velocity_scale_within_a_step_of_the_sensor_is_no_finding(problem, steps, judged):
    step = 0.05  # [m/s]
    records = [
        replace(
            one,
            measurements=replace(
                one.measurements,
                measured=np.column_stack(
                    [one.measurements.measured[:, 0],
                     step * np.round(one.measurements.measured[:, 1] / step)]
                ),
            ),
        )
        for one in problem.records
    ]  # fmt: skip
    coarse = PredictionErrorProblem.from_records(records)
    values = {**GAINS, "velocity-scale.scale": 1.0 + steps * step / coarse.top_speed}
    done = added(coarse, ("velocity-scale", 1.0, 2.0), values=values)

    found = judge_effects(coarse, done, ResidualSummary(), damaged=False)

    assert [one.effect for one in found] == ["velocity-scale"] * judged


@pytest.mark.parametrize(
    "rest",
    [
        ResidualSummary(worst_window=WorstWindow(20.0, 0, 0.5, 0.6)),
        ResidualSummary(repeated=RepeatedResidual(9.0, "position", 1, 0.4, 0.5)),
        ResidualSummary(peak=SpectralPeak(300.0, 1.7)),
    ],
    ids=["a moment", "a place", "a rhythm"],
)
@pytest.mark.parametrize(("after", "size"), [(0.7, "minor"), (0.5, "major")])
def test_effect_needs_a_large_share_of_the_gap_while_residuals_remain(problem, rest, after, size):
    values = {**GAINS, "drag.drag": 0.03, "spring.rate": 0.1, "spring.preload": 0.1}
    alone = added(problem, ("drag", 2.0 * after, 2.0), values=values)
    alike = added(problem, ("drag", 1.1, 1.05), ("spring", 1.0, 1.1), values=values)

    def sizes(done):
        found = find_effects(problem, done, residuals=rest)
        return [one.size for one in found]

    assert sizes(alone) == [size]
    assert sizes(alike) == ["minor", "minor"]  # neither, nor either


@pytest.mark.parametrize(
    ("score", "others", "named"),
    [
        (400.0, {}, True),
        (400.0, {"heating": 9.0, "inertia-change": 390.0}, True),  # which happens once
        (50.0, {"heating": 48.0}, False),  # as like as not
        (5.0, {}, False),
    ],
)
def test_an_effect_is_a_finding_if_it_is_likelier_right_than_wrong(problem, score, others, named):
    values = {**GAINS, "battery-sag.share": 0.3}
    base, one = added(problem, ("battery-sag", 1.9, 2.0), values=values)
    scores = {"battery-sag": score, **others}
    tried = [
        TriedCandidate(name, each, 1.0, admitted=False, why="") for name, each in scores.items()
    ]
    plain = rounds(problem, 2.0)[0].candidate
    base = replace(with_tried(base, tried), candidate=plain)
    bare = replace(one.candidate, bic=one.candidate.bic + score)
    done = [base, replace(one, without=bare)]

    (judged,) = judge_effects(problem, done, ResidualSummary(), damaged=False)
    found = find_effects(problem, done, residuals=ResidualSummary())
    remarks = list_remarks(problem, done, found, [judged], ResidualSummary())

    assert (judged.probability >= LEAST_PROBABILITY) is named
    assert [each.probability for each in found] == [judged.probability] * named
    assert len(select_reported_rounds(done, found)) == (2 if named else 1)
    assert any(f"only {judged.probability:.0%}," in one for one in remarks) is not named
    # A likely effect may be no finding for another reason, and is then not called unlikely.
    unnamed = list_remarks(problem, done, [], [judged], ResidualSummary())
    assert any("only" in one for one in unnamed) is not named


@pytest.mark.parametrize(
    ("names", "doubted"),
    [
        (["spring", "gravity-cosine"], True),
        (["gravity-cosine", "constant-load"], True),  # a spring's simpler sister, in turn
        (["spring", "cogging"], False),  # a wave that comes back is no bent spring
        (["gravity-cosine", "drag"], False),
        (["spring"], False),
    ],
)
def test_related_effects_found_together_are_reported_as_ambiguous(problem, names, doubted):
    findings = [replace(DRAG, effect=name) for name in names]

    verdict, remainder, remains = reach_verdict(
        findings, rounds(problem, 40.0, 1.1), problem, residuals=ResidualSummary(), unit=METERS
    )

    assert (verdict, remainder) == ("explained", doubted)
    assert all(name in remains for name in names) is doubted
