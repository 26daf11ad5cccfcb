"""What every fit stands on: measurements, the Kalman gain, information, lags and runs."""

import math
from dataclasses import replace

import numpy as np
import pytest
from handmade import each

from sim.bench.mechanisms import MECHANISMS
from sim.bench.recorder import RECORDERS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.estimation.kalman import make_steady_state_filter
from sim.estimation.measurements import (
    SensorNoise,
    bend_voltage,
    compute_noise_at_speed,
    compute_third_differences,
    estimate_noise,
    measure_runs,
)
from sim.estimation.model_structure import ModelStructure
from sim.fit import fit
from sim.fit.information_matrix import compute_information
from sim.fit.run_differences import fit_run_differences
from sim.fit.search import fit_tracking, make_fit_problem
from sim.fit.sysid_rows import Rows
from sim.physics.engine import NO_CORRECTION, RunBatch, filter_runs
from sim.physics.model import Model, Part
from sim.physics.velocity_lag import estimate_velocity_lag


def even(count=400, period=0.02):
    return np.arange(count) * period


def uneven(count=400, period=0.02, *, seed=1):
    rng = np.random.default_rng(seed)
    return even(count, period) + rng.uniform(-0.2, 0.2, count) * period


def test_third_differences_on_even_times_are_the_ordinary_formula():
    values = np.random.default_rng(0).standard_normal(50)

    assert compute_third_differences(even(50), values) == pytest.approx(np.diff(values, 3))


def test_third_differences_of_a_parabola_are_zero_at_uneven_times():
    time = uneven()

    left = compute_third_differences(time, 3.0 - 2.0 * time + 5.0 * time**2)

    assert np.abs(left).max() < 1e-10


def test_noise_that_grows_with_the_speed_counts_at_the_speeds_of_the_log():
    # a velocity from the time between two edges of an encoder is off by a share of the speed
    time = even(4000, 0.005)
    share = 0.05 * np.random.default_rng(4).standard_normal(time.size)
    velocity = 0.6 * time * (1.0 + share)
    run = Run("dynamic-forward", time, np.full(time.size, 4.0), 0.3 * time**2, velocity)
    seen = measure_runs(Log((run,), units="meters", type="simple"), friction=None)
    noise = estimate_noise(seen)

    found = compute_noise_at_speed(seen, noise)

    assert found == pytest.approx(float(np.std(0.6 * time * share)), rel=0.1)
    assert found > 1.1 * noise.velocity


@pytest.mark.parametrize("name", sorted(MECHANISMS))
def test_the_noise_of_a_position_is_that_of_its_sensor(name):
    # the smallest change from one sample to the next says how slow it was, not how coarse it is
    mechanism = MECHANISMS[name]
    log = simulate(mechanism, Routine(step=3.5), rng=np.random.default_rng(1))

    noise = estimate_noise(measure_runs(log, friction=None))

    rounding = mechanism.sensor.resolution / 12**0.5
    assert 0.8 * rounding < noise.position < 1.5 * rounding
    assert noise.velocity == pytest.approx(mechanism.sensor.velocity_noise, rel=0.15)


def test_a_count_that_single_precision_reads_as_two_numbers_is_one_count():
    time, step = even(2000, 0.005), 2e-3  # [m/s], longer on one count than on the way to the next
    counts = np.round(0.05 * time / step)
    rounded = (counts * step) * (1.0 + 1e-7 * np.random.default_rng(5).choice([-1, 1], time.size))
    run = Run("quasistatic-forward", time, np.full(time.size, 4.0), 0.025 * time**2, rounded)

    found = estimate_noise(measure_runs(Log((run,)), friction=None))

    assert found.velocity == pytest.approx(step / np.sqrt(12.0), rel=0.01)


def test_bent_voltage_has_the_mean_of_the_smooth_voltage_between_its_samples():
    def volts(time):
        return 3.0 + 40.0 * time - 150.0 * time**2

    time, period = even(12), 0.02
    slides = np.append(np.diff(volts(time)), 0.0)
    true = [np.mean(volts(one + np.linspace(0.0, period, 2001))) for one in time[:-1]]
    straight = volts(time) + 0.5 * slides
    bent = straight + bend_voltage(slides)
    assert bent[1:-2] == pytest.approx(true[1:-1], abs=1e-4)  # their mean is over 2001 points


def test_voltage_next_to_a_held_sample_is_not_bent():
    assert not bend_voltage(np.array([0.0, 1.2, 0.6, 0.0, 0.0])).any()


MODEL = Model("simple", {"kS": 0.2, "kV": 2.5, "kA": 0.2})
KALMAN_NOISE = SensorNoise(position=1e-5, velocity=0.0075, resolution=(1e-6, 1e-6))
PERIOD = 0.02


def run_kalman_filter(process_noise):
    return make_steady_state_filter(
        MODEL.gains["kV"],
        MODEL.gains["kA"],
        noise=KALMAN_NOISE,
        process_noise=process_noise,
        period=PERIOD,
    )


def solve_riccati(process_noise, voltage_error, *, before=3000):
    """The gain at each sample, by the recursion of the textbook, from a state that is known."""
    rate = MODEL.gains["kV"] / MODEL.gains["kA"]
    kept = math.exp(-rate * PERIOD)
    step = np.array([[1.0, (1.0 - kept) / rate], [0.0, kept]])
    push = process_noise * np.array([[PERIOD**3 / 3, PERIOD**2 / 2], [PERIOD**2 / 2, PERIOD]])
    half = math.exp(-rate * PERIOD / 2)
    late = np.array([PERIOD / 2 - (1.0 - half) / rate, 1.0 - half]) / MODEL.gains["kV"]
    early = np.array([[1.0, (1.0 - half) / rate], [0.0, half]]) @ late
    volt = 2.0 * (np.outer(early, early) + np.outer(late, late))  # of two halves, each off alone
    rough = np.diag([KALMAN_NOISE.position**2, KALMAN_NOISE.velocity**2])
    cov, gains = np.zeros((2, 2)), []
    for error in (*np.zeros(before), *voltage_error):
        cov = step @ cov @ step.T + push + volt * error**2
        gain = cov @ np.linalg.inv(cov + rough)
        cov = cov - gain @ cov
        gains.append(gain.ravel())
    return np.array(gains[before:])


@pytest.mark.parametrize("process_noise", [1e-6, 1e-3])
def test_the_steady_kalman_gain_is_the_limit_of_the_recursion(process_noise):
    (gain,) = solve_riccati(process_noise, [0.0])

    assert run_kalman_filter(process_noise).steady.ravel() == pytest.approx(gain, rel=1e-3)


@pytest.mark.parametrize("process_noise", [1e-6, 1e-3])
def test_gains_after_an_uncertain_voltage_are_those_of_the_recursion(process_noise):
    error = np.zeros(60)
    error[5], error[6], error[20] = 0.1, 0.05, 0.3

    schedule = run_kalman_filter(process_noise).schedule(error)

    expected = solve_riccati(process_noise, error)
    assert schedule.gains == pytest.approx(expected, abs=0.02 * np.abs(expected).max())
    assert schedule.gains[5:8] == pytest.approx(expected[5:8], rel=0.02)
    assert {5, 6, 20} <= set(schedule.uncertain.tolist())


def test_innovations_of_uncertain_samples_are_scaled_to_the_usual_covariance():
    error = np.zeros(10)
    error[4] = 0.2
    one = run_kalman_filter(1e-4)

    schedule = one.schedule(error)

    usual = one.predicted_cov + np.diag(one.measured_var)
    seen = usual + one.voltage_cov * 0.2**2
    scale = schedule.scales[schedule.uncertain.tolist().index(4)]
    assert scale @ seen @ scale.T == pytest.approx(usual, rel=1e-9)


def rows(velocity, acceleration, position=None):
    """Rows of which only the motion matters here."""
    n = len(velocity)
    empty = np.zeros(n)
    return Rows(
        np.arange(n) * 0.02,
        np.full(n, 0.02),
        empty,
        empty if position is None else np.asarray(position, dtype=float),
        np.asarray(velocity, dtype=float),
        np.asarray(acceleration, dtype=float),
    )


BOTH = {
    "quasistatic-forward": rows([0.5, 1.0, 1.5], [0.4, 0.4, 0.4]),
    "quasistatic-reverse": rows([-0.5, -1.0, -1.5], [-0.4, -0.4, -0.4]),
    "dynamic-forward": rows([0.2, 0.6, 1.1], [8.0, 4.0, 2.0]),
}
UP = {test: part for test, part in BOTH.items() if test.endswith("forward")}


def test_errors_are_those_of_repeated_fits():
    rng = np.random.default_rng(1)
    v = np.concatenate([part.velocity for part in BOTH.values()])
    a = np.concatenate([part.acceleration for part in BOTH.values()])
    columns = np.column_stack([np.sign(v), v, a])
    volts = columns @ [0.2, 2.5, 0.2] + 0.05 * rng.standard_normal((4000, v.size))
    found = np.linalg.lstsq(columns, volts.T, rcond=None)[0]
    said = compute_information(BOTH, type="simple", noise=0.05).errors
    assert said == pytest.approx(
        dict(zip(("kS", "kV", "kA"), found.std(axis=1), strict=True)), rel=0.04
    )


def test_an_elevator_that_only_goes_up_never_separates_friction_from_weight():
    errors = compute_information(UP, type="elevator", noise=0.05).errors
    assert math.isinf(errors["kS"])
    assert math.isinf(errors["kG"])
    assert math.isfinite(errors["kV"])
    assert math.isfinite(errors["kA"])


@pytest.mark.parametrize(
    ("ask", "advice"),
    [
        (lambda: compute_information({}, type="simple", noise=0.1), "at least one test that moves"),
        (lambda: compute_information(UP, type="crane", noise=0.1), "Choose one of: simple"),
        (lambda: compute_information(UP, type="simple", noise=0.0), "must be above 0"),
    ],
    ids=["no rows", "no such type", "no noise"],
)
def test_unidentifiable_gain_is_refused_with_advice(ask, advice):
    with pytest.raises(BadRequest, match=advice):
        ask()


GENTLE = Routine(ramp=0.5, step=3.5)


def bench(name="drivetrain", *, period=0.005, seed=1):
    rng = np.random.default_rng(seed)
    return simulate(MECHANISMS[name].draw(rng), GENTLE, rng=rng, period=period)


def late(run, *, by):
    return replace(run, velocity=np.interp(run.time - by, run.time, run.velocity))


def averaged(run, *, window):
    """The velocity as a controller averages it: the way gone in a window, over the window."""
    past = np.interp(run.time - window, run.time, run.position)
    return replace(run, velocity=(run.position - past) / window)


def held(run, n):
    """The run with readings that change only every ``n`` samples, as a sensor's frames do."""
    latest = np.arange(len(run)) // n * n
    return replace(run, position=run.position[latest], velocity=run.velocity[latest])


@pytest.mark.parametrize("lag", [0.0, 0.03, 0.112, 0.2])
@pytest.mark.parametrize("period", [0.02, 0.005])
@pytest.mark.parametrize("name", MECHANISMS)
def test_a_planted_delay_is_found_to_five_milliseconds(name, period, lag):
    log = each(bench(name, period=period), lambda run: late(run, by=lag))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(lag, abs=0.005)


def test_an_average_is_a_delay_of_half_its_window():
    log = each(bench(), lambda run: averaged(run, window=0.1))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(0.05, abs=0.005)


def test_repeated_frames_do_not_change_the_estimated_delay():
    log = each(bench(), lambda run: held(late(run, by=0.06), 4))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(0.06, abs=0.006)


def test_runs_that_disagree_have_a_large_error():
    log = bench()
    spread = replace(log, runs=tuple(late(run, by=0.03 * i) for i, run in enumerate(log.runs)))

    assert estimate_velocity_lag(log.runs).error < 0.003
    assert estimate_velocity_lag(spread.runs).error > 0.01
    assert np.isnan(estimate_velocity_lag(log.runs[:1]).error)


GAINS = {"kS": 0.2, "kV": 2.0, "kA": 0.3}


def recorded(name, recorder, *, seed):
    device = RECORDERS[recorder]
    chance = np.random.default_rng([seed, 77])
    return simulate(device.record(MECHANISMS[name]), Routine(), rng=chance, period=device.period)


def simple_problem(log):
    problem = make_fit_problem(log, measure_runs(log, friction=None))
    truth = MECHANISMS["drivetrain"].gains
    return problem, fit_tracking(problem, ModelStructure("simple"), truth)


@pytest.mark.parametrize("late", [0.004, 0.03])
def test_a_run_with_a_lag_of_its_own_moves_as_a_model_with_a_delay(late):
    time = np.arange(0.0, 2.0, 0.02)
    still, count = np.zeros(1), time.size
    batch = RunBatch(
        edges=np.array([0.0, count]), time=time, voltage=3.0 * np.sin(4.0 * time),
        voltage_slide=np.zeros(count), measured=np.full((count, 2), np.nan), position=still,
        velocity=still, low=still - math.inf, high=still + math.inf, clocks=still,
        memory_groups=still,
    )  # fmt: skip

    def moved(model, lag):
        return filter_runs(
            model, batch, kalman_gain=NO_CORRECTION, position_offset=still, backlash_phase=still,
            friction_offset=still, lag_offset=np.array([lag]),
        )  # fmt: skip

    plain = Model("simple", GAINS)
    delayed = plain + Part("delay", {"lag": late})

    assert moved(plain, late) == pytest.approx(moved(delayed, 0.0), abs=1e-12)
    assert np.abs(moved(plain, late) - moved(plain, 0.0)).max() > 1e-3


@pytest.mark.parametrize("name", ["drivetrain", "swerve"])
def test_runs_that_are_late_by_different_frames_do_not_shift_static_friction(name):
    found = fit(recorded(name, "talonfx", seed=200))

    assert found.gains["kS"] == pytest.approx(MECHANISMS[name].gains["kS"], rel=0.003)
    assert found.gains["kA"] == pytest.approx(MECHANISMS[name].gains["kA"], rel=0.005)


def test_the_runs_differ_by_the_age_of_their_frames():
    log = recorded("drivetrain", "talonfx", seed=200)
    problem, point = simple_problem(log)

    extended, found = fit_run_differences(problem, point, every=problem, period=0.02)

    lags = found.values["delay.lag"] + found.nuisance.lag_offset
    assert extended.lag_sd == pytest.approx(0.02 / math.sqrt(12.0))
    assert np.all((lags > -0.002) & (lags < 0.022))
    assert np.ptp(lags) > 0.005  # the frames of this seed are 4 to 14 ms old


def test_a_frame_that_is_read_twice_is_not_compared():
    log = recorded("drivetrain", "roborio", seed=1)
    run = log.runs[2]
    seen = {"position": run.position.copy(), "velocity": run.velocity.copy()}
    for readings in seen.values():
        readings[101] = readings[100]
    repeated = replace(log, runs=(Run(run.test, run.time, run.voltage, **seen),))

    (measured,) = measure_runs(repeated, friction=None)

    assert np.flatnonzero(np.isnan(measured.measured).all(axis=1)).tolist() == [100, 101]


def frictions_by_run(name, shares, *, seed):
    """A log whose runs have frictions of their own, as shares of that of the mechanism."""
    mechanism = MECHANISMS[name]
    logs = [
        simulate(
            replace(mechanism, friction=mechanism.friction * share),
            Routine(),
            rng=np.random.default_rng([seed, number]),
        )
        for number, share in enumerate(shares)
    ]
    return replace(logs[0], runs=tuple(log.runs[number] for number, log in enumerate(logs)))


@pytest.mark.parametrize(("name", "seed"), [("drivetrain", 9), ("turret", 3), ("elevator", 5)])
def test_friction_that_differs_by_run_is_not_taken_for_lag(name, seed):
    shares = 1.0 + 0.04 * np.random.default_rng(seed).standard_normal(4)
    found = fit(frictions_by_run(name, shares, seed=seed), type=MECHANISMS[name].type)
    truth = MECHANISMS[name].friction

    assert abs(found.gains["kS"] - truth * shares.mean()) < 2.0 * found.errors["kS"]
    assert found.errors["kS"] > 0.008 * truth  # 4 % of four runs, of which the sample tells some
