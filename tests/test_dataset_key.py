"""The key of a dataset and its secret: what they tell, to whom, and what the data do not tell."""

from dataclasses import replace

import numpy as np
import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, key, make_dataset, spec, sysid
from places import read_all

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.core.units import find_unit
from sim.support.secret import Secret


def test_the_key_holds_the_true_gains_in_the_units_of_the_log(tmp_path):
    text = PLAIN.replace("count = 2", "drawn = false").replace("timeout = 1.0", "timeout = 6.0")
    folder = make_dataset(spec(tmp_path, text))

    truth = {log["mechanism"]: log for log in key(folder)["logs"]}

    turn = 2 * np.pi  # a shooter's log counts rotations
    assert truth["drivetrain"]["units"] == "meters"
    assert truth["drivetrain"]["gains"] == pytest.approx(MECHANISMS["drivetrain"].gains)
    assert truth["shooter"]["units"] == "rotations"
    assert truth["shooter"]["gains"]["kV"] == pytest.approx(
        MECHANISMS["shooter"].gains["kV"] * turn
    )
    log = sim.read(folder / next(iter(truth["shooter"]["files"])))
    (step,) = log.list_runs_of_test("dynamic-forward")
    top = step.velocity[-10:].mean() / turn  # [rot/s] near its end, where kA has nothing to do
    gains = truth["shooter"]["gains"]
    assert gains["kS"] + gains["kV"] * top == pytest.approx(3.0, rel=0.02)


def test_the_key_says_what_was_done_to_each_log_and_where(tmp_path):
    folder = make_dataset(spec(tmp_path, DAMAGED))

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
    folder = make_dataset(spec(tmp_path, text))

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


def test_the_key_names_the_effects_that_are_hidden_and_they_act(tmp_path):
    effect = '[[logs.effects]]\nname = ["drag", "stribeck"]\nsize = [1.5, 2.0]\n'
    clean = read_all(make_dataset(spec(tmp_path), "clean"))

    folder = make_dataset(spec(tmp_path, PLAIN + effect))

    found = {}
    for log in key(folder)["logs"]:
        (hidden,) = log["hidden"]
        built = replace(MECHANISMS[log["mechanism"]], **log["built"])
        again = built.hide(hidden["effect"], size=hidden["size"])
        found[hidden["effect"]] = hidden["size"]
        assert 1.5 <= hidden["size"] <= 2.0
        assert again.hidden[0].to_json(find_unit(log["units"])) == hidden["parameters"]
    assert set(found) == {"drag", "stribeck"}  # four logs with this seed draw both
    assert not [name for name, data in read_all(folder).items() if clean[name] == data]


def test_files_in_the_data_folder_do_not_reveal_the_truth(tmp_path):
    folder = make_dataset(spec(tmp_path, DAMAGED))

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
    for file, data in read_all(folder).items():
        assert not [word for word in told if word in file or word.encode() in data]
    assert len({path.stat().st_mtime for path in folder.rglob("log*")}) == 1


def test_a_secret_is_made_on_first_use_and_kept(tmp_path, capsys):
    path = spec(tmp_path, DAMAGED, secret="")

    first = read_all(make_dataset(path, "one"))
    said = capsys.readouterr().err
    again = read_all(make_dataset(path, "two"))

    assert (
        said
        == f"{tmp_path / 'class.secret'}: a new secret. Keep this file, and show it to nobody.\n"
    )
    assert capsys.readouterr().err == ""
    assert first == again
    assert len((tmp_path / "class.secret").read_text(encoding="utf-8").strip()) == 64


def test_the_environment_may_hold_the_secret(tmp_path, monkeypatch):
    kept = read_all(make_dataset(spec(tmp_path, DAMAGED)))
    (tmp_path / "class.secret").unlink()
    monkeypatch.setenv("SYSID_SECRET", SECRET)

    assert read_all(make_dataset(tmp_path / "spec.toml", "from-environment")) == kept
    assert not (tmp_path / "class.secret").exists()


def test_a_refused_request_makes_no_secret(tmp_path):
    path = spec(tmp_path, DAMAGED, secret="")
    (tmp_path / "data").write_text("a file", encoding="utf-8")

    assert sysid("dataset", path, "-o", tmp_path / "data") == 2
    assert not (tmp_path / "class.secret").exists()


def test_a_secret_does_not_show_in_a_message():
    assert SECRET not in repr(Secret(SECRET.encode(), hidden=True))
