"""The server of `sysid open`: for its own page alone, and no log ends it."""

import http.client
import json
import subprocess
import sys
from dataclasses import replace
from urllib.parse import urlencode

import numpy as np
import pytest
from open_page import BROKEN, ask, ask_json, drive_log, served, slipped_log, write_log
from sysid_process import run_sysid

from sim.cli import sysid
from sim.cli.open.session import LiveView, Session
from sim.core.doubt import Doubt
from sim.core.units import TURN
from sim.feedback import PRESETS
from sim.fit import Fit, fit
from sim.fit.physics import Parts
from sim.io import read
from sim.physics.motors import MOTORS
from sim.reconcile.gains import replace_gains
from sim.support.command_line import run_command

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """A server without logs, for requests that change nothing."""
    with served(tmp_path_factory.mktemp("session")) as running:
        yield running


@pytest.fixture
def drive(tmp_path):
    """An ordinary log, whose encoder slipped once."""
    return write_log(slipped_log(), tmp_path / "drive one.wpilog")


def test_server_gives_the_page_to_this_machine_alone(server):
    status, content = ask(server, "")

    assert status == 200
    assert b"Drop a log." in content
    assert server.server_address[0] == "127.0.0.1"


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "evil.example:80"},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://127.0.0.1:1"},
        {"Origin": "https://localhost"},
    ],
    ids=str,
)
@pytest.mark.parametrize("method", ["GET", "POST", "DELETE"])
def test_a_foreign_host_or_origin_is_refused(server, headers, method):
    body = b"x" if method == "POST" else None
    status, said = ask_json(server, "logs", headers=headers, method=method, body=body)

    assert status == 403
    assert said["refusal"]["what"] == "this page answers only to itself"
    assert server.session.logs == ()


@pytest.mark.parametrize("word", ["", "wrong", "..", "%C3%A9"])
def test_server_answers_nothing_without_the_secret_word_of_its_address(server, word):
    connection = http.client.HTTPConnection("127.0.0.1", server.server_address[1], timeout=20)
    connection.putrequest("GET", f"/{word}/logs", skip_host=True)
    connection.putheader("Host", server.hosts[0])
    connection.endheaders()
    answer = connection.getresponse()

    assert answer.status == 404
    answer.read()
    connection.close()


@pytest.mark.parametrize(
    "path",
    ["../server.py", "%2e%2e/server.py", "server.py", "logs/1/summary", "logs/x/fit", "a/b/c/d"],
)
def test_nothing_but_the_page_is_served(server, path):
    status, content = ask(server, path)
    assert status == 404 or b'"refusal"' in content


def test_a_dropped_log_is_read_inspected_and_fitted(server, drive):
    status, opened = ask_json(server, "logs?name=drive%20one.wpilog", body=drive.read_bytes())
    of_log = f"logs/{opened['id']}"
    _, summary = ask_json(server, f"{of_log}/summary")
    _, samples = ask(server, f"{of_log}/samples")
    _, faults = ask_json(server, f"{of_log}/faults")
    _, found = ask_json(server, f"{of_log}/fit")
    log = read(drive)
    expected = fit(log)

    assert (status, opened["name"]) == (200, "drive one.wpilog")
    assert [run["test"] for run in summary["runs"]] == [run.test for run in log.runs]
    numbers = np.frombuffer(samples, dtype="<f8")
    assert numbers.size == 4 * summary["samples"]
    np.testing.assert_array_equal(numbers[: len(log.runs[0])], log.runs[0].time)
    assert [one["fault"] for one in faults["faults"]] == ["encoder-slip"]
    assert {one["name"]: one["value"] for one in found["gains"]} == dict(expected.gains)
    assert len(found["starts"]) == len(log.runs)
    assert ask(server, of_log, method="DELETE")[0] == 200
    assert ask_json(server, f"{of_log}/summary")[1]["refusal"]["what"].startswith("this log is not")


@pytest.mark.parametrize("headers", [{"Host": "evil.example"}, {"Origin": "http://evil.example"}])
def test_the_watched_log_is_shown_to_its_own_page_alone(tmp_path, headers):
    with served(tmp_path) as server:
        server.session.live = LiveView("following robot.wpilog", {}, "secret")
        refused = ask(server, "live", headers=headers)
        elsewhere = ask(server, "live", word="wrong")

    assert (refused[0], elsewhere[0]) == (403, 404)
    assert b"secret" not in refused[1] + elsewhere[1]


def test_growing_log_is_fitted_again_from_its_finished_tests(tmp_path, drive):
    log = read(drive)
    with served(tmp_path) as server:
        none = ask_json(server, "live")[1]
        server.session.live = LiveView("following drive", {"dynamic-forward": 0}, "next")
        answers = []
        for count in (3, 4):
            finished = {"": replace(log, runs=log.runs[:count])}
            server.session.renew("robot", drive, finished)
            live = ask_json(server, "live")[1]
            summary = ask_json(server, f"logs/{live['logs'][0]['id']}/summary")[1]
            gains = ask_json(server, f"logs/{live['logs'][0]['id']}/fit")[1]["gains"]
            answers.append((live["logs"], len(summary["runs"]), gains))
        server.session.close(answers[0][0][0]["id"])
        server.session.renew("robot", drive, finished)
        closed = ask_json(server, "live")[1]["logs"]

    assert none == {"follows": False, "logs": []}
    assert [(logs[0]["revision"], runs) for logs, runs, _ in answers] == [(1, 3), (2, 4)]
    expected = fit(log).in_log_units().gains
    assert {one["name"]: one["value"] for one in answers[1][2]} == dict(expected)
    assert answers[0][2] != answers[1][2]
    assert closed == []


def test_the_report_is_that_of_the_fit(tmp_path, drive):
    with served(tmp_path / "session", drive) as server:
        status, content = ask(server, "logs/1/report.html")

    assert status == 200
    assert b'"name": "drive one.wpilog"' in content


def test_request_for_a_missing_value_is_no_http_error(tmp_path, drive):
    with served(tmp_path, drive) as server:
        status, said = ask_json(server, "logs/1/code?language=phoenix6")

    assert (status, said["refusal"]["asks"]) == (200, "radius")


def test_ten_broken_logs_do_not_end_the_server(tmp_path):
    (tmp_path / "session").mkdir()
    said = {}
    with served(tmp_path / "session") as server:
        for name, content in BROKEN.items():
            status, opened = ask_json(server, f"logs?name={name}", body=content)
            assert status == 200
            said[name] = ask_json(server, f"logs/{opened['id']}/summary")
            for what in ("faults", "fit", "directions", "code", "report.html"):
                assert ask(server, f"logs/{opened['id']}/{what}")[0] == 200
        assert ask(server, "")[0] == 200

    assert {status for status, _ in said.values()} == {200}
    assert said["empty.wpilog"][1]["refusal"]["where"] == "empty.wpilog"
    for _, answer in said.values():
        if "refusal" in answer:
            assert answer["refusal"]["advice"]
            assert str(tmp_path) not in json.dumps(answer)


def test_a_mistake_of_ours_is_reported_and_does_not_end_the_server(tmp_path, drive, monkeypatch):
    with served(tmp_path, drive) as server:
        monkeypatch.setattr(server.session.find(1), "combine_runs", lambda _reading: 1 / 0)
        status, answer = ask_json(server, "logs/1/summary")
        assert ask(server, "")[0] == 200

    assert status == 500
    assert "our mistake, not yours (ZeroDivisionError" in answer["refusal"]["what"]


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ("../../etc/passwd", "passwd"),
        ("C:\\logs\\a.csv", "a.csv"),
        ("..", "log"),
        ('a"<b>.wpilog', "a__b_.wpilog"),
        ("x" * 500 + ".csv", "x" * 116 + ".csv"),
        ("größe 1.csv", "größe 1.csv"),
    ],
)
def test_a_dropped_name_becomes_a_file_in_the_sessions_folder(tmp_path, given, name):
    plain, path = Session(tmp_path).choose_place(given)

    assert (plain, path.name) == (name, name)
    assert path.parent.parent == tmp_path


def test_a_taken_port_is_refused_in_one_line(server):
    port = str(server.server_address[1])
    done = run_sysid("open", "--port", port)

    assert done.returncode == 2
    assert f"port {port} cannot be used" in done.stderr
    assert done.stderr.count("\n") == 1


def test_the_command_prints_its_address_and_ends_with_ctrl_c(drive):
    code = (
        "import webbrowser, sim.cli.open.server as it\n"
        "from sim.cli import main\n"
        "def stop(server): raise KeyboardInterrupt\n"
        "it.PageServer.serve_forever = stop\n"
        "main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "open", str(drive), "--no-browser"],
        capture_output=True, encoding="utf-8", check=False, timeout=60,
    )  # fmt: skip

    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("The page is at http://127.0.0.1:")


def test_the_first_requests_may_come_all_at_once(tmp_path, drive):
    """In a process of its own: threads that import the same modules could find them half made."""
    code = (
        "import sys, threading, urllib.request, pathlib\n"
        "from sim.cli.open.server import PageServer\n"
        "from sim.cli.open.session import Session\n"
        "server = PageServer(Session(pathlib.Path(sys.argv[1]), [pathlib.Path(sys.argv[2])]))\n"
        "threading.Thread(target=server.serve_forever, daemon=True).start()\n"
        "found = []\n"
        "def ask(what):\n"
        "    with urllib.request.urlopen(f'{server.address}logs/1/{what}') as answer:\n"
        "        found.append(answer.status)\n"
        "names = ['summary', 'samples', 'faults', 'fit', 'directions', 'code', 'report.html']\n"
        "threads = [threading.Thread(target=ask, args=(name,)) for name in names]\n"
        "threads.append(threading.Thread(target=server.session.warm_up))\n"
        "[thread.start() for thread in threads]\n"
        "[thread.join() for thread in threads]\n"
        "print(found == [200] * len(names))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path), str(drive)],
        capture_output=True, encoding="utf-8", check=False, timeout=120,
    )  # fmt: skip

    assert (done.stdout.strip(), done.stderr) == ("True", "")


def test_example_is_simulated(tmp_path):
    with served(tmp_path) as server:
        _, opened = ask_json(server, "example", body=b"")
        _, faults = ask_json(server, f"logs/{opened['id']}/faults")

    assert opened["name"] == "example drivetrain.wpilog"
    assert "encoder-slip" in [one["fault"] for one in faults["faults"]]


def test_a_search_excludes_the_part_that_was_left_out(server, drive):
    one = server.session.add(drive.name, drive)
    fault = ask_json(server, f"logs/{one.number}/faults")[1]["faults"][0]
    part = f"{fault['test']}:{fault['start_s'] - 0.001:.3f}-{fault['end_s'] + 0.001:.3f}"
    names = []
    for query in ("", f"?left_out={part}"):
        story = None
        while story is None:
            story = ask_json(server, f"logs/{one.number}/reconcile{query}")[1]["story"]
        names.append([finding["name"] for finding in story["findings"]])

    assert names == [["encoder-slip"], []]


def test_page_and_robot_code_show_the_warnings_of_the_command(tmp_path, capsys):
    path = write_log(drive_log(3, "arm", step=2.0), tmp_path / "log.wpilog")
    run_command(sysid, name="sysid", arguments=["fit", str(path), "--json"])
    told = json.loads(capsys.readouterr().out)
    with served(tmp_path, path) as server:
        found = ask_json(server, "logs/1/fit")[1]
        more = ask_json(server, "logs/1/directions")[1]
        code = ask_json(server, "logs/1/code?language=python")[1]["code"]

    known = {one["code"] for one in told["warnings"]}
    shown = {one["code"] for one in found["doubts"]}
    assert known
    assert known <= shown
    assert more["word"] in {"Check first", "Partly usable", "Usable", found["word"]}
    assert code.count("\n# - ") == 1 + len(found["doubts"]) + len(more["doubts"])
    assert "# - Verdict: kS" in code
    assert str(tmp_path) not in code


def test_code_names_a_sure_fault_until_it_is_left_out(tmp_path, drive):
    with served(tmp_path, drive) as server:
        code = ask_json(server, "logs/1/code")[1]["code"]
        (slip,) = ask_json(server, "logs/1/faults")[1]["faults"]
        part = f"{slip['test']}:{slip['start_s'] - 0.01}-{slip['end_s'] + 0.01}"
        rest = ask_json(server, f"logs/1/code?{urlencode({'left_out': part})}")[1]["code"]

    assert f"// - Encoder slip in {slip['test']}." in code
    assert "Encoder slip" not in rest
    assert "Left out" not in code
    assert f"// Left out: {slip['test']}, {slip['start_s'] - 0.01:.2f} to " in rest


def test_page_writes_the_code_of_the_command(tmp_path, drive, capsys):
    part = "quasistatic-forward:5-6.5"
    arguments = ["fit", str(drive), "--leave-out", part, "--paste", "java"]
    run_command(sysid, name="sysid", arguments=arguments)
    printed = capsys.readouterr().out
    with served(tmp_path, drive) as server:
        code = ask_json(server, f"logs/1/code?{urlencode({'left_out': part})}")[1]["code"]
        moved = ask_json(server, "logs/1/code?language=python&kV=2.75")[1]["code"]

    assert code == printed
    assert "// Left out: quasistatic-forward, 5.00 to 6.50 s" in code
    assert "# Moved by hand, not measured: kV" in moved


def test_each_piece_that_is_left_of_a_run_is_simulated_from_its_own_start(tmp_path, drive):
    with served(tmp_path, drive) as server:
        whole = ask_json(server, "logs/1/fit")[1]
        cut = ask_json(server, "logs/1/fit?left_out=quasistatic-forward:5-6.5")[1]
    run = read(drive).runs[0]

    ((only,), *_), ((before, after), *_) = whole["starts"], cut["starts"]
    assert before["first"] == only["first"]
    assert run.time[before["first"] + before["count"] - 1] < 5.0
    assert run.time[after["first"]] > 6.5
    assert before["count"] + after["count"] == only["count"] - np.count_nonzero(
        (run.time >= 5.0) & (run.time <= 6.5)
    )


def test_a_unit_that_contradicts_the_file_is_a_doubt_of_the_verdict(tmp_path):
    path = write_log(drive_log(), tmp_path / "log.wpilog")
    with served(tmp_path, path) as server:
        own = ask_json(server, "logs/1/fit")[1]
        other = ask_json(server, "logs/1/fit?units=feet")[1]

    assert own["word"] == "Usable"
    assert other["word"] == "Check first"
    assert other["verdict"].startswith("kS usable")
    assert "kV not usable" in other["verdict"]


def test_a_unit_error_is_told_in_words_of_the_page(tmp_path):
    log = drive_log()
    runs = [replace(run, velocity=60.0 * run.velocity) for run in log.runs]
    path = write_log(replace(log, runs=tuple(runs)), tmp_path / "log.csv")
    with served(tmp_path, path) as server:
        faults = ask_json(server, "logs/1/faults")[1]["faults"]
        refused = ask_json(server, "logs/1/code")[1]["refusal"]

    assert {one["fault"] for one in faults} == {"unit-error"}
    assert "correct the log" in faults[0]["advice"]
    for words in (faults[0]["advice"], refused["what"], refused["advice"]):
        assert "--ignore" not in words
        assert "sysid inspect" not in words


def test_another_unit_converts_typed_gains_and_wrong_numbers_are_refused(server):
    gains = {"kS": 0.2, "kV": 2.5, "kA": 0.3}
    turned = urlencode(gains | {"units": "rotations", "before": "radians"})
    found = ask_json(server, f"feedback?{turned}")[1]["gains"]
    refused = [
        ask_json(server, f"feedback?{urlencode(gains | wrong)}")[1]["refusal"]["what"]
        for wrong in ({"kV": "x"}, {"volts": 0}, {"velocity_error": -1})
    ]

    assert found["kV"] == pytest.approx(2.5 * TURN)
    assert found["kS"] == 0.2
    assert refused == ["'x' is no kV", "'0' is no volts", "'-1' is no velocity error"]


def test_model_with_effects_keeps_the_warnings_about_the_log():
    log = Doubt("unit-error", "The unit is wrong.", gains=("kV",))
    misfit = Doubt("model-strays", "The model strays.")
    moved = Doubt("gains-move", "They move.", gains=("kA",))
    plain = Fit.from_gains({"kS": 0.1, "kV": 2.0, "kA": 0.1}, type="simple", units="meters")
    plain = replace(plain, doubts=(log, misfit))

    assert replace_gains(plain, {}, (), (moved,), narrows=True).doubts == (log, moved)
    kept = replace_gains(plain, {}, (), (moved,), narrows=False).doubts
    assert [one.code for one in kept] == ["unit-error", "small-misfit", "gains-move"]


@pytest.mark.parametrize("preset", PRESETS)
def test_typed_gains_get_the_feedback_gains_of_a_fit_in_the_controllers_units(server, preset):
    gains = {"kS": 0.2, "kV": 2.5, "kA": 0.3}
    query = urlencode(gains | {"units": "meters", "preset": preset})
    rows = ask_json(server, f"feedback?{query}")[1]["rows"]

    expected = Fit.from_gains(gains, type="simple", units="meters").feedback(PRESETS[preset])
    per = {"velocity": PRESETS[preset].format_units("velocity", "m")[0]}
    assert rows
    assert {one["loop"] for one in rows} <= set(expected)
    for one in rows:
        own, symbol = f"kP {expected[one['loop']].kp:.4g} ", per.get(one["loop"], "/m")
        first = one["gains"].split(", ")[0]
        assert first == "no good start" or first.endswith(symbol)
        assert own in (one["instead"] or one["gains"])
        assert symbol in one["instead"] or first.startswith(own)


def test_smaller_allowed_errors_give_larger_feedback_gains(server):
    query = {"kS": 0.2, "kV": 2.5, "kA": 0.3, "velocity_error": 0.5, "position_error": 0.05}
    wide, tight = (
        ask_json(server, f"feedback?{urlencode(query | allowed)}")[1]["rows"]
        for allowed in ({"velocity_error": 2.0, "position_error": 0.2}, {})
    )

    for one, other in zip(wide, tight, strict=True):
        assert float(one["gains"].split()[1]) < float(other["gains"].split()[1])


def test_theory_gives_gains_without_a_log_and_asks_for_the_radius(server):
    built = {"motor": "neo", "count": 2, "ratio": 10.71, "load": 50.0, "units": "meters", "kS": 0.1}
    said = ask_json(server, f"feedback?{urlencode(built)}")[1]
    found = ask_json(server, f"feedback?{urlencode(built | {'radius': 0.0762})}")[1]

    assert "radius is missing" in said["refusal"]["what"]
    parts = Parts(MOTORS["neo"], 2, 10.71, radius=0.0762, load=50.0)
    assert found["gains"]["kV"] == pytest.approx(parts.kv)
    assert found["gains"]["kA"] == pytest.approx(parts.ka)
    assert found["rows"]


def test_any_number_of_the_log_is_sampled_at_its_runs(tmp_path, drive):
    with served(tmp_path, drive) as server:
        entries = ask_json(server, "logs/1/entries")[1]
        name = next(one["name"] for one in entries if one["signal"] == "voltage")
        _, content = ask(server, f"logs/1/entry?{urlencode({'name': name})}")
        refused = ask_json(server, "logs/1/entry?name=none")[1]

    expected = np.concatenate([run.voltage for run in read(drive).runs])
    np.testing.assert_array_equal(np.frombuffer(content, dtype="<f8"), expected)
    assert "no numbers named 'none'" in refused["refusal"]["what"]
