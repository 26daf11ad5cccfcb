"""sysid dataset: one spec and secret, always the same files, and a key that tells the truth."""

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, files, key, make, spec, sysid

import sim
from sim.dataset import making
from sim.dataset.plan import plan
from sim.dataset.secret import Secret, find_secret
from sim.dataset.spec import read_spec
from sim.mechanisms import MECHANISMS
from sim.simulate import simulate
from sim.units import unit


@pytest.fixture(autouse=True)
def _no_secret_around(monkeypatch):
    monkeypatch.delenv("SYSID_SECRET", raising=False)


def jobs_of(path):
    asked = read_spec(path)
    return plan(asked, find_secret(asked, make=False))


def test_a_dataset_is_logs_in_a_folder_and_a_key_beside_it(tmp_path, capsys):
    folder = make(spec(tmp_path))

    assert list(files(folder)) == [f"log-0{number}.wpilog" for number in (1, 2, 3, 4)]
    assert sorted(log["mechanism"] for log in key(folder)["logs"]) == [
        "drivetrain", "drivetrain", "shooter", "shooter",
    ]  # fmt: skip
    assert capsys.readouterr().out == (
        f"{folder}: 4 logs. The truth about them: {tmp_path / 'data.key.json'}\n"
    )


def test_students_have_folders_of_their_own_and_each_format_is_written(tmp_path):
    made = files(make(spec(tmp_path, DAMAGED)))

    assert list(made) == [
        f"{student}/log-0{number}.{ending}"
        for student in ("ann", "bo")
        for number in (1, 2, 3, 4)
        for ending in ("csv", "wpilog")
    ]


def test_both_formats_of_a_log_hold_the_same_numbers(tmp_path):
    folder = make(spec(tmp_path, DAMAGED))

    for entry in key(folder)["logs"]:
        csv, wpilog = (
            sim.read(folder / file, units=entry["units"]) for file in sorted(entry["files"])
        )
        for one, other in zip(csv.runs, wpilog.runs, strict=True):
            assert one.test == other.test
            assert np.array_equal(one.velocity, other.velocity)


def test_the_same_spec_and_secret_give_the_same_bytes(tmp_path):
    path = spec(tmp_path, DAMAGED)

    assert files(make(path, "one")) == files(make(path, "two"))
    assert key(tmp_path / "one") == key(tmp_path / "two")


@pytest.mark.parametrize(
    "other",
    [
        pytest.param({"text": DAMAGED, "secret": SECRET + "!"}, id="another secret"),
        pytest.param({"text": DAMAGED.replace("week3", "week4")}, id="another name"),
    ],
)
def test_anything_else_gives_other_bytes_in_every_file(tmp_path, other):
    (tmp_path / "other").mkdir()
    ours = files(make(spec(tmp_path, DAMAGED)))

    theirs = files(make(spec(tmp_path / "other", **other)))

    assert list(ours) == list(theirs)
    assert not [file for file in ours if ours[file] == theirs[file]]


def test_no_two_logs_are_alike(tmp_path):
    made = files(make(spec(tmp_path, DAMAGED)))

    assert len(set(made.values())) == len(made)


def test_two_processes_make_what_one_makes(tmp_path):
    path = spec(tmp_path, PLAIN.replace("count = 2", "count = 30"))  # 60 logs: worth two

    one = make(path, "one", "--processes", 1)
    two = make(path, "two", "--processes", 2)

    assert len(files(one)) == 60
    assert files(one) == files(two)
    assert key(one) == key(two)


def test_a_job_does_not_depend_on_the_others(tmp_path):
    jobs = jobs_of(spec(tmp_path, DAMAGED))

    there = {job.name: making.make(job).contents for job in jobs}
    back = {job.name: making.make(job).contents for job in reversed(jobs)}

    assert there == back


def test_more_students_leave_the_logs_of_the_others_as_they_are(tmp_path, capsys):
    before = files(make(spec(tmp_path, DAMAGED)))

    after = files(make(spec(tmp_path, DAMAGED.replace('["ann"', '["zoe", "ann"'))))

    assert before.items() <= after.items()
    assert len(after) == len(before) + 8
    assert "12 logs, 8 of them made earlier" in capsys.readouterr().out


def test_a_fault_is_all_that_differs_from_the_clean_log(tmp_path):
    fault = '[[logs.faults]]\nname = "loop-overrun"\ntest = "dynamic-forward"\n'
    clean = {job.seed: job for job in jobs_of(spec(tmp_path))}
    spoilt = {job.seed: job for job in jobs_of(spec(tmp_path, PLAIN + fault))}

    assert clean.keys() == spoilt.keys()
    for seed, job in clean.items():
        here, there = making.make(job), making.make(spoilt[seed])
        assert here.truth["gains"] == there.truth["gains"]
        assert here.contents != there.contents


def test_another_processor_gives_the_same_bytes(tmp_path, monkeypatch):
    def other_processor(*arguments, **named):
        log = simulate(*arguments, **named)
        return replace(log, runs=tuple(replace(run, **last_bits(run)) for run in log.runs))

    def last_bits(run):
        names = ("time", "voltage", "position", "velocity")
        return {name: np.nextafter(getattr(run, name), np.inf) for name in names}

    path = spec(tmp_path, DAMAGED)
    here = files(make(path, "here"))
    monkeypatch.setattr(making, "simulate", other_processor)  # its last bit is another

    assert files(make(path, "there")) == here


def test_the_key_holds_the_true_gains_in_the_units_of_the_log(tmp_path):
    text = PLAIN.replace("count = 2", "drawn = false").replace("timeout = 1.0", "timeout = 6.0")
    folder = make(spec(tmp_path, text))

    truth = {log["mechanism"]: log for log in key(folder)["logs"]}

    turn = 2 * np.pi  # a shooter's log counts rotations
    assert truth["drivetrain"]["units"] == "meters"
    assert truth["drivetrain"]["gains"] == pytest.approx(MECHANISMS["drivetrain"].gains)
    assert truth["shooter"]["units"] == "rotations"
    assert truth["shooter"]["gains"]["kV"] == pytest.approx(
        MECHANISMS["shooter"].gains["kV"] * turn
    )
    log = sim.read(folder / next(iter(truth["shooter"]["files"])))
    (step,) = log.of("dynamic-forward")
    top = step.velocity[-10:].mean() / turn  # [rot/s] near its end, where kA has nothing to do
    gains = truth["shooter"]["gains"]
    assert gains["kS"] + gains["kV"] * top == pytest.approx(3.0, rel=0.02)


def test_the_key_says_what_was_done_to_each_log_and_where(tmp_path):
    folder = make(spec(tmp_path, DAMAGED))

    logs = key(folder)["logs"]
    damaged = [log for log in logs if log["faults"]]

    assert [len(log["faults"]) for log in damaged] == [2] * 4
    assert sorted(log["student"] for log in damaged) == ["Bo", "Bo", "ann", "ann"]
    for log in damaged:
        first, second = log["faults"]
        assert first["fault"] == "loop-overrun"
        assert 0.5 <= first["severity"] <= 1.5
        assert second["fault"] in {"missing-test", "sign-flip"}


def test_a_damaged_part_is_counted_in_the_log_as_it_is(tmp_path):
    text = """
name = "runs"
seed = 3
routine = { timeout = 2.0 }
[[logs]]
mechanisms = "shooter"
[[logs.faults]]
name = "loop-overrun"
test = "dynamic-reverse"
[[logs.faults]]
name = "missing-test"
test = "quasistatic-forward"
"""
    folder = make(spec(tmp_path, text))

    (entry,) = key(folder)["logs"]
    log = sim.read(folder / "log-01.wpilog")
    (overrun,) = entry["faults"][0]["where"]
    (missing,) = entry["faults"][1]["where"]

    assert [run.test for run in log.runs].index("dynamic-reverse") == overrun["run"] == 2
    run = log.runs[overrun["run"]]
    assert overrun["test"] == run.test
    inside = (run.time >= overrun["start_s"] - 1e-6) & (run.time <= overrun["end_s"] + 1e-6)
    assert np.diff(run.time[inside]).max() > 1.5 * 0.02  # the gap is where the key says
    assert missing["run"] is None


def test_a_log_holds_the_tests_that_are_asked_for(tmp_path):
    tests = '["coast-reverse", "quasistatic-forward", "quasistatic-reverse"]'
    text = PLAIN.replace("step = 3.0", f"step = 3.0\ntests = {tests}\nelectrical = true")

    log = sim.read(make(spec(tmp_path, text)) / "log-01.wpilog")

    assert [run.test for run in log.runs] == [
        "quasistatic-forward", "quasistatic-reverse", "coast-reverse",
    ]  # fmt: skip
    assert all(run.current is not None and run.bus_voltage is not None for run in log.runs)


def test_the_key_names_the_effects_that_are_hidden_and_they_act(tmp_path):
    effect = '[[logs.effects]]\nname = ["drag", "stribeck"]\nsize = [1.5, 2.0]\n'
    clean = files(make(spec(tmp_path), "clean"))

    folder = make(spec(tmp_path, PLAIN + effect))

    found = {}
    for log in key(folder)["logs"]:
        (hidden,) = log["hidden"]
        built = replace(MECHANISMS[log["mechanism"]], **log["built"])
        again = built.hiding(hidden["effect"], size=hidden["size"])
        found[hidden["effect"]] = hidden["size"]
        assert 1.5 <= hidden["size"] <= 2.0
        assert again.hidden[0].said(unit(log["units"])) == hidden["parameters"]
    assert set(found) == {"drag", "stribeck"}  # four logs with this seed draw both
    assert not [name for name, data in files(folder).items() if clean[name] == data]


def test_the_hash_in_the_key_is_that_of_the_file(tmp_path):
    folder = make(spec(tmp_path, DAMAGED))

    made = files(folder)
    hashes = {file: found for log in key(folder)["logs"] for file, found in log["files"].items()}

    assert hashes == {file: hashlib.sha256(data).hexdigest() for file, data in made.items()}


def test_nothing_in_the_folder_gives_the_truth_away(tmp_path):
    folder = make(spec(tmp_path, DAMAGED))

    truth = key(folder)["logs"]
    told = {
        "loop-overrun",
        "loop_overrun",
        "missing",
        "sign-flip",
        "seed",
        "severity",
        "key",
        SECRET,
    }
    told |= {log["seed"][:12] for log in truth} | {log["seed"][-12:] for log in truth}
    told |= {repr(value) for log in truth for value in log["gains"].values()}
    for file, data in files(folder).items():
        assert not [word for word in told if word in file or word.encode() in data]
    assert len({path.stat().st_mtime for path in folder.rglob("log*")}) == 1


def test_a_number_says_nothing_about_what_was_done_to_a_log(tmp_path):
    text = PLAIN.replace("seed = 1", 'secret = "class.secret"\nstudents = {names}')
    names = json.dumps([f"student {number}" for number in range(40)])
    fault = '[[logs]]\nmechanisms = "shooter"\n[[logs.faults]]\nname = "sign-flip"\n'
    jobs = jobs_of(spec(tmp_path, text.replace("{names}", names) + fault))

    numbers = [job.name[-2:] for job in jobs if job.strikes]

    assert len(numbers) == 40
    assert set(numbers) == {
        "01",
        "02",
        "03",
        "04",
        "05",
    }  # 40 draws miss one of five 1 time in 1500


def test_no_room_for_temporary_files_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(making.tempfile, "tempdir", str(tmp_path / "none"))

    assert sysid("dataset", spec(tmp_path), "-o", tmp_path / "data") == 2

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "a temporary file cannot be written (No such file or directory). Make room" in said


def test_a_secret_is_made_on_first_use_and_kept(tmp_path, capsys):
    path = spec(tmp_path, DAMAGED, secret="")

    first = files(make(path, "one"))
    said = capsys.readouterr().err
    again = files(make(path, "two"))

    assert said == f"{tmp_path / 'class.secret'}: a new secret. Keep it, and keep it to yourself.\n"
    assert capsys.readouterr().err == ""
    assert first == again
    assert len((tmp_path / "class.secret").read_text(encoding="utf-8").strip()) == 64


def test_two_secrets_that_are_made_differ(tmp_path):
    made = []
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        make(spec(tmp_path / name, DAMAGED, secret=""))
        made.append((tmp_path / name / "class.secret").read_bytes())

    assert made[0] != made[1]


def test_the_environment_may_hold_the_secret(tmp_path, monkeypatch):
    kept = files(make(spec(tmp_path, DAMAGED)))
    (tmp_path / "class.secret").unlink()
    monkeypatch.setenv("SYSID_SECRET", SECRET)

    assert files(make(tmp_path / "spec.toml", "from-environment")) == kept
    assert not (tmp_path / "class.secret").exists()


def test_a_refused_request_makes_no_secret(tmp_path):
    path = spec(tmp_path, DAMAGED, secret="")
    (tmp_path / "data").write_text("a file", encoding="utf-8")

    assert sysid("dataset", path, "-o", tmp_path / "data") == 2
    assert not (tmp_path / "class.secret").exists()


def test_a_secret_does_not_show_in_a_message():
    assert SECRET not in repr(Secret(SECRET.encode(), hidden=True))


def test_the_example_can_be_made_as_it_is(tmp_path, capsys):
    path = tmp_path / "week3.toml"

    assert sysid("dataset", path, "--example") == 0
    folder = make(path)

    assert f"sysid dataset {path} -o week3" in capsys.readouterr().out
    assert len(files(folder)) == 2 * (2 * 2 + 3)  # students x (mechanisms x clean + damaged)
    assert sysid("dataset", path, "--example") == 2  # what is there is not overwritten
