"""A learner's code is run apart: it reaches nothing, stops nothing, and returns only numbers."""

import ctypes
import os
import platform
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
from places import ROOT

from grader.isolation import (
    FunctionCall,
    Limits,
    find_isolation_level,
    landlock,
    run_functions,
    sandbox_parent,
    seccomp,
)
from grader.isolation.scratch import remove_tree
from grader.student_data.variant import use_class_secret

SHORT = Limits(seconds=0.6)  # where the end of it is waited for
LONG = Limits(seconds=10.0)  # where it is not, however busy the machine
LEVEL = find_isolation_level()
NO_ISOLATION = "" if LEVEL.startswith("isolated") else f"this system is {LEVEL}"
isolated = pytest.mark.skipif(bool(NO_ISOLATION), reason=NO_ISOLATION or "isolated")
posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such call")


@pytest.fixture
def apart_run(tmp_path):
    """Runs a learner's text; calls ``fit`` as often as asked, with the number of the call."""

    def start(text, *, times=1, limits=LONG, **data):
        file = tmp_path / "fit.py"
        file.write_text(text, encoding="utf-8")
        calls = [FunctionCall("fit", {"number": number, **data}) for number in range(times)]
        return run_functions(file, calls=calls, limits=limits)

    return start


ABIS = {"all there is": None, "Landlock as on Linux 6.7": 4}


@pytest.fixture(params=[*ABIS, "limits only"])
def each_level(request, monkeypatch):
    """With all the confinement this system has, with an older kernel's, and with limits only."""
    monkeypatch.setattr(sandbox_parent, "CONFINED", request.param != "limits only")
    monkeypatch.setattr(sandbox_parent, "LANDLOCK_ABI", ABIS.get(request.param))
    return request.param


@pytest.fixture(params=ABIS)
def each_kernel(request, monkeypatch):
    """With all the confinement this system has, and with an older kernel's."""
    monkeypatch.setattr(sandbox_parent, "LANDLOCK_ABI", ABIS[request.param])


@pytest.fixture
def victim():
    """A process of the same user, for others to end."""
    with subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"]) as process:
        yield process
        process.kill()


@pytest.fixture
def listening():
    """A server on this machine: its port, and who came."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        came = []

        def accept():
            try:
                came.append(server.accept()[0])
            except OSError:
                return

        thread = threading.Thread(target=accept, daemon=True)
        thread.start()
        yield server.getsockname()[1], came
        server.shutdown(socket.SHUT_RDWR) if came == [] else came[0].close()
        thread.join(1.0)


def attempt(code):
    """A fit that tries something and says 1 if it worked; else it stops with the reason."""
    lines = "\n".join(f"    {line}" for line in code.splitlines())
    return f"import os, sys\ndef fit(number):\n{lines}\n    return {{'worked': 1.0}}\n"


# --- what is believed -----------------------------------------------------------------------------

NUMBERS = [
    ("1.5", 1.5),
    ("3", 3.0),
    ("np.float64(1.5)", 1.5),
    ("np.float32(0.5)", 0.5),
    ("np.int64(7)", 7.0),
    ("np.array(2.5)", 2.5),
]
NO_NUMBERS = [
    ("float('nan')", "nan"),
    ("float('-inf')", "infinity"),
    ("10**400", "infinity"),
    ("None", "None"),
    ("True", "True, which is yes or no"),
    ("'0.5'", 'the text "0.5"'),
    ("[0.5]", "a list"),
    ("1j", "a complex"),
    ("np.array([0.5])", "an array of shape (1,)"),
    ("np.nan", "nan"),
    ("np.bool_(True)", "True, which is yes or no"),
    ("Sly(0.5)", "a Sly, which only looks like a number"),
    ("fit", "a function"),
]
SLY = """
import numpy as np
class Sly(float):
    def __sub__(self, other): return Sly(0)
    def __abs__(self): return Sly(0)
    def __le__(self, other): return True
    __lt__ = __rsub__ = __eq__ = __le__
    __hash__ = None
"""


@pytest.mark.usefixtures("each_level")
def test_child_returns_plain_floats_and_the_type_of_anything_else(apart_run):
    items = [text for text, _ in NUMBERS + NO_NUMBERS]
    listed = ", ".join(f"'n{index}': {text}" for index, text in enumerate(items))
    (answer,) = apart_run(
        f"{SLY}\ndef fit(number, x):\n    return {{{listed}}}\n", x=np.ones(2)
    ).answers

    good, bad = len(NUMBERS), len(NO_NUMBERS)
    assert [answer.numbers[f"n{i}"] for i in range(good)] == [value for _, value in NUMBERS]
    assert {type(value) for value in answer.numbers.values()} == {float}
    assert [answer.refused[f"n{good + i}"] for i in range(bad)] == [why for _, why in NO_NUMBERS]


def test_only_requested_scipy_can_be_imported_in_the_sandbox(tmp_path, reads):
    file = tmp_path / "fit.py"
    file.write_text(
        "def fit():\n    from scipy.linalg import det\n    return {'d': det([[2.0]])}\n"
        "def plot():\n    import matplotlib\n",
        encoding="utf-8",
    )
    calls = [FunctionCall("fit"), FunctionCall("plot")]
    with_it = run_functions(file, calls=calls, packages=("numpy", "scipy")).answers
    without = run_functions(file, calls=calls[:1]).answers

    assert dict(with_it[0].numbers) == {"d": 2.0}
    reads(with_it[1].reason)
    reads(without[0].reason)


# --- crashes --------------------------------------------------------------------------------------

CRASHES = [
    ("def fit(number):\n    return {'a': 1 / number}\n", "line 2: ZeroDivisionError: division by"),
    ("def fit(number):\n  return {\n", "line 2: SyntaxError: '{' was never closed"),
    ("import nothing_here\n", "line 1: ModuleNotFoundError: No module named 'nothing_here'"),
    ("x = 1\n", "fit.py: TypeError: there is no function fit"),
    ("def fit(t):\n    return {}\n", "fit.py: TypeError: fit() got an unexpected keyword"),
    ("def fit(number):\n    raise SystemExit(0)\n", "line 2: SystemExit: 0"),
    ("def fit(number):\n    input()\n", "line 2: EOFError: EOF when reading a line"),
    ("def fit(number):\n    fit(number)\n", "line 2: RecursionError: maximum recursion depth"),
    ("def fit(number):\n    raise ValueError('a\\nb\\x1b[2J')\n", "line 2: ValueError: a"),
    ("raise SystemExit\n", "line 1: SystemExit"),
]


@pytest.mark.parametrize(("text", "says"), CRASHES, ids=[says for _, says in CRASHES])
def test_a_crash_gets_one_line_that_names_file_and_line(apart_run, text, says):
    outcome = apart_run(text)
    reason = outcome.answers[0].reason

    assert reason.startswith("fit.py")
    assert says in reason
    assert reason.isprintable()


# --- the tricks: none earns a number, none stops anything -----------------------------------------


@pytest.mark.usefixtures("each_level")
@pytest.mark.parametrize(
    "end",
    [
        "os._exit(0)",
        "os._exit(3)",
        "while True: pass",
        "os.closerange(0, 100)",
    ],
)
def test_answers_given_before_an_end_are_kept(apart_run, end, reads):
    begin = time.monotonic()
    text = (
        f"import os\ndef fit(number):\n    if number == 2:\n        {end}\n"
        "    return {'n': number}\n"
    )
    outcome = apart_run(text, times=4, limits=SHORT)

    assert [dict(one.numbers) for one in outcome.answers] == [{"n": 0.0}, {"n": 1.0}, {}, {}]
    reads(outcome.answers[2].reason)
    reads(outcome.ended)
    assert time.monotonic() - begin < 20.0


@pytest.mark.usefixtures("each_level")
def test_a_flood_of_output_is_dropped_and_reported(apart_run):
    text = "def fit(number):\n    for _ in range(50): print('x' * 1_000_000)\n    return {'n': 1}\n"
    outcome = apart_run(text, limits=Limits(seconds=30.0))

    assert dict(outcome.answers[0].numbers) == {"n": 1.0}
    assert len(outcome.printed) < 5000
    assert outcome.printed.endswith(f"and {50 * 1_000_001 - 4000:,} bytes more, which were dropped")


@pytest.mark.usefixtures("each_level")
def test_the_pipe_takes_only_lines_with_the_nonce_and_only_so_many(apart_run):
    text = (
        "import os\ndef fit(number):\n"
        '    line = b\'{"call": 0, "result": {"names": [["n", 7]]}}\\n\'\n'
        "    for fd in range(3, 20):\n"
        "        try: os.write(fd, b'[' * 9999 + b'\\n' + line + b'x' * 9_000_000)\n"
        "        except OSError: pass\n"
        "    return {'n': 1}\n"
    )
    outcome = apart_run(text, times=2)

    assert 7.0 not in [number for one in outcome.answers for number in one.numbers.values()]


@pytest.mark.usefixtures("each_level")
def test_patching_the_checker_in_the_child_does_not_change_the_parent(apart_run):
    text = (
        "import builtins, json, sys\n"
        "class Yes:\n    def __getattr__(self, name): return Yes()\n"
        "    def __call__(self, *a, **k): return Yes()\n"
        "for module in list(sys.modules.values()):\n"
        "    for name in ('check', 'judge', 'right', 'grade', 'receive', 'isfinite'):\n"
        "        setattr(module, name, Yes())\n"
        "frame = sys._getframe()\n"
        "while frame:\n"
        "    for value in [*frame.f_locals.values(), *frame.f_globals.values()]:\n"
        "        if isinstance(value, dict) and 'limits' in value: value['limits'] = {}\n"
        "    frame = frame.f_back\n"
        "def fit(number): return {'n': 5.0, 'right': True}\n"
    )
    (answer,) = apart_run(text).answers

    assert (dict(answer.numbers), dict(answer.refused)) == (
        {"n": 5.0},
        {"right": "True, which is yes or no"},
    )


@pytest.mark.usefixtures("each_level")
def test_parent_never_unpickles_or_imports_output_of_the_child(apart_run, tmp_path):
    marker = tmp_path / "marker"
    text = (
        "import os, pickle, sys\n"
        f"mark = {str(marker)!r}\n"
        "class Bomb:\n    def __reduce__(self): return (open, (mark, 'w'))\n"
        "def fit(number):\n"
        "    for fd in range(1, 20):\n"
        "        try: os.write(fd, pickle.dumps(Bomb()) + b'\\n')\n"
        "        except OSError: pass\n"
        "    for name in ('sitecustomize.py', 'json.py', 'numpy.py'):\n"
        "        open(name, 'w').write(f'open({mark!r}, chr(119))')\n"
        "    return {'n': Bomb()}\n"
    )
    (answer,) = apart_run(text).answers

    assert dict(answer.refused) == {"n": "a Bomb"}
    assert not marker.exists()


@pytest.mark.usefixtures("each_level")
def test_neither_arguments_nor_environment_nor_memory_hold_a_secret(apart_run, monkeypatch):
    monkeypatch.setenv("CLASS_SECRET", "swordfish")
    text = (
        "import gc, os, sys\n"
        "def fit(number):\n"
        "    seen = repr((sys.argv, sys.orig_argv, dict(os.environ)))\n"
        "    frame = sys._getframe()\n"
        "    while frame:\n"
        "        seen += repr(frame.f_locals)\n"
        "        frame = frame.f_back\n"
        "    found = [one for one in gc.get_objects() if isinstance(one, (dict, list, tuple))]\n"
        "    seen += ''.join(str(one) for one in found if len(one) < 50)\n"
        "    name = ''.join(['sword', 'fish'])\n"
        "    ours = any(n.startswith('grader') for n in sys.modules)\n"
        "    return {'secret': name in seen, 'grader': ours}\n"
    )
    with use_class_secret(b"swordfish"):
        (answer,) = apart_run(text).answers

    assert answer.reason == ""
    assert dict(answer.refused) == {
        "secret": "False, which is yes or no",
        "grader": "False, which is yes or no",
    }


def unreadable():
    """Files a learner's code must not see: how to say the path inside the child."""
    course = Path(__file__).resolve().parents[1]
    packages = Path(os.__file__).parent / "site-packages"  # of the Python that pytest's grew from
    inside = next((file for file in packages.rglob("*.py") if file.stat().st_size), __file__)
    return {
        "a package beside Python's own library": str(inside),
        "a package nobody asked for": pytest.__file__,
        "the grader": str(course / "grader" / "student_data" / "variant.py"),
        "its own program": str(course / "grader" / "isolation" / "sandbox_child.py"),
        "an exercise's checks": str(course / "exercises" / "exercise9" / "checks.py"),
        "the bench": str(course / "sim" / "bench" / "mechanisms" / "shooter.py"),
        "the parent's memory": f"/proc/{os.getpid()}/maps",
        "the parent's environment": f"/proc/{os.getpid()}/environ",
        "the system's users": "/etc/passwd",
    }


@isolated
@pytest.mark.usefixtures("each_kernel")
@pytest.mark.parametrize("name", unreadable())
def test_sandbox_cannot_read_a_key_file(apart_run, name):
    (answer,) = apart_run(attempt(f"open({unreadable()[name]!r}).read()")).answers

    assert "PermissionError" in answer.reason


@isolated
@pytest.mark.usefixtures("each_kernel")
@pytest.mark.parametrize(
    "code",
    [
        "open({file!r}).read()",
        "open({file!r}, 'w')",
        "open({file!r} + '.new', 'w')",
        "os.listdir(os.path.dirname({file!r}))",
        "os.remove({file!r})",
        "os.rename({file!r}, {file!r} + '2')",
        "os.truncate({file!r}, 0)",
        "os.chmod({file!r}, 0)",
        "os.chown({file!r}, 1, 1)",
        "os.utime({file!r}, (0, 0))",
        "os.link({file!r}, 'mine')",
        "os.symlink({file!r}, 'mine'); open('mine').read()",
    ],
)
def test_another_learners_file_is_neither_read_nor_changed(apart_run, tmp_path, code):
    other = tmp_path / "others.toml"
    other.write_text("kS = 0.5", encoding="utf-8")
    before = other.stat()
    (answer,) = apart_run(attempt(code.format(file=str(other)))).answers
    after = other.stat()

    assert "Error" in answer.reason
    assert other.read_text(encoding="utf-8") == "kS = 0.5"
    assert (before.st_mode, before.st_mtime, before.st_uid) == (
        after.st_mode,
        after.st_mtime,
        after.st_uid,
    )
    assert sorted(file.name for file in tmp_path.iterdir()) == ["fit.py", "others.toml"]


@isolated
@pytest.mark.usefixtures("each_kernel")
@pytest.mark.parametrize(
    "code",
    [
        "os.fork()",
        "for _ in range(200): os.fork()",
        "import subprocess; subprocess.run([sys.executable, '-c', ''])",
        "os.system('true') == 0 or os.fork()",
        "os.execv('/bin/true', ['true'])",
        "os.posix_spawn('/bin/true', ['true'], {})",
        "os.setsid()",
        "os.chroot('.')",  # which root may, and nobody else
        "os.kill(os.getppid(), 0)",
        "os.kill(-1, 0)",
        "import resource; resource.prlimit(os.getppid(), resource.RLIMIT_CPU, (1, 1))",
        "import resource; resource.setrlimit(resource.RLIMIT_CPU, (999, 999))",
    ],
)
def test_sandbox_cannot_start_or_signal_processes(apart_run, code):
    (answer,) = apart_run(attempt(code)).answers

    assert "Error" in answer.reason


@isolated
@pytest.mark.usefixtures("each_kernel")
@pytest.mark.parametrize("kind", ["SOCK_STREAM", "SOCK_DGRAM"])
def test_sandbox_has_no_network(apart_run, listening, kind):
    port, came = listening
    code = f"import socket; s = socket.socket(type=socket.{kind}); s.connect(('127.0.0.1', {port}))"
    (answer,) = apart_run(attempt(code)).answers

    assert "PermissionError" in answer.reason
    assert came == []


OWNED = """import fcntl, signal, struct
reader, writer = os.pipe()
{give}
fcntl.fcntl(reader, 10, signal.SIGKILL)  # F_SETSIG
fcntl.fcntl(reader, fcntl.F_SETFL, fcntl.fcntl(reader, fcntl.F_GETFL) | os.O_ASYNC)
os.write(writer, b"now")
"""
FCNTL = seccomp.TABLES[platform.machine()].fcntl if platform.machine() in seccomp.TABLES else 0
OWNERS = {
    "F_SETOWN": "fcntl.fcntl(reader, fcntl.F_SETOWN, {pid})",
    "F_SETOWN_EX": "fcntl.fcntl(reader, 15, struct.pack('ii', 1, {pid}))",
    "high bits": "import ctypes\nif ctypes.CDLL(None, use_errno=True).syscall({fcntl}, reader, "
    "ctypes.c_long((1 << 32) + 8), ctypes.c_long({pid})) < 0:\n"
    "    raise OSError(ctypes.get_errno())",
}


@isolated
@pytest.mark.usefixtures("each_kernel")
@pytest.mark.parametrize("give", OWNERS)
def test_a_file_given_to_another_process_sends_it_no_signal(apart_run, victim, give):
    code = OWNED.format(give=OWNERS[give].format(pid=victim.pid, fcntl=FCNTL))
    (answer,) = apart_run(attempt(code)).answers

    assert "Error" in answer.reason
    with pytest.raises(subprocess.TimeoutExpired):
        victim.wait(0.2)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux has F_SETSIG")
def test_unfiltered_signal_ends_the_other_process(apart_run, victim, monkeypatch):
    monkeypatch.setattr(sandbox_parent, "CONFINED", False)
    code = OWNED.format(give=OWNERS["F_SETOWN"].format(pid=victim.pid))
    (answer,) = apart_run(attempt(code)).answers

    assert answer.reason == ""
    assert victim.wait(5) == -9


def verdict(table, number, *arguments):
    """What the filter returns for a system call: an interpreter of its few instructions."""
    words = {0: number, 4: table.architecture, 16: 0, 24: 0}
    words |= {16 + 8 * at: value for at, value in enumerate(arguments)}
    steps, at, kept = [*seccomp._make_filter(table)], 0, 0
    while True:
        code, yes, no, value = steps[at]
        at += 1
        if code == seccomp.RETURN:
            return value
        if code == seccomp.LOAD:
            kept = words[value]
        else:
            right = {
                seccomp.EQUAL: kept == value,
                seccomp.AT_LEAST: kept >= value,
                seccomp.ANY_BIT: bool(kept & value),
            }[code]
            at += yes if right else no


@pytest.mark.parametrize("machine", seccomp.TABLES)
def test_the_filter_refuses_owners_of_files_on_each_processor(machine):
    table = seccomp.TABLES[machine]
    refused = [
        (number, command)
        for number in (table.fcntl, table.ioctl)
        for command in (0, 1, 2, 3, 4, 8, 9, 10, 15, 16, 1030, 0x5401, 0x8901, 0x8902, 0x8903)
        if verdict(table, number, 3, command) == seccomp.REFUSE
    ]

    owners = [(table.fcntl, 8), (table.fcntl, 10), (table.fcntl, 15)]
    assert refused == [*owners, (table.ioctl, 0x8901), (table.ioctl, 0x8902)]
    assert verdict(table, 9999) == seccomp.ALLOW
    assert verdict(table, table.own[0], os.getpid()) == seccomp.ALLOW


@isolated
@pytest.mark.usefixtures("each_kernel")
def test_shared_memory_of_other_programs_is_protected(apart_run):
    system = ctypes.CDLL(None, use_errno=True)
    shared = system.shmget(0, 4096, 0o1600)
    assert shared >= 0
    try:
        for call in (f"shmat({shared}, None, 0)", f"shmctl({shared}, 0, None)"):
            code = f"import ctypes\nassert ctypes.CDLL(None).{call} != -1"
            (answer,) = apart_run(attempt(code)).answers
            assert "AssertionError" in answer.reason, call
        assert system.shmctl(shared, 2, ctypes.create_string_buffer(256)) == 0  # still there
    finally:
        system.shmctl(shared, 0, None)


@posix
@pytest.mark.skipif(sys.platform == "darwin", reason="macOS does not hold programs to it")
@pytest.mark.usefixtures("each_level")
def test_memory_and_files_are_limited(apart_run):
    hog = apart_run(attempt("bytearray(4 * 1024**3)")).answers[0].reason
    wide = apart_run(attempt("open('big', 'wb').write(bytes(32 * 1024**2))")).answers[0].reason

    assert "MemoryError" in hog
    assert "File too large" in wide


@posix
def test_processor_time_is_limited_and_the_end_says_so(reads):
    code = (
        "from grader.isolation.limits import set_limits\n"
        "set_limits(seconds=1, memory=2**31, file=1, processes=True)\n"
        "while True: pass\n"
    )
    ended = subprocess.run([sys.executable, "-c", code], timeout=20, check=False).returncode

    reads(sandbox_parent._explain_end(ended))


@posix
def test_processes_of_the_child_end_with_it(apart_run, monkeypatch, tmp_path):
    monkeypatch.setattr(sandbox_parent, "CONFINED", False)  # else there are none
    note = tmp_path / "pids"
    text = (
        "import os, time\ndef fit(number):\n    for _ in range(20):\n"
        f"        pid = os.fork()\n        if pid == 0: time.sleep(30)\n"
        f"        open({str(note)!r}, 'a').write(f'{{pid}}\\n')\n    while True: pass\n"
    )
    outcome = apart_run(text, limits=Limits(seconds=0.5))
    born = [int(line) for line in note.read_text().split()] if note.exists() else []

    assert outcome.seconds < 20.0
    assert not [pid for pid in born if alive(pid)]


def alive(pid):
    """Whether a process still runs; one that only waits to be counted out does not."""
    said = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, check=False)  # noqa: S607 - every system with fork has it
    return said.stdout.strip()[:1] not in {b"", b"Z"}


@pytest.mark.skipif(not landlock.find_abi_version(), reason="this system has no Landlock")
def test_kernel_isolates_the_child_where_it_can():
    assert LEVEL.startswith(f"isolated (Landlock ABI {landlock.find_abi_version()}, ")
    if platform.machine() in seccomp.TABLES:
        assert LEVEL.endswith("system calls filtered)")


def test_isolation_level_names_the_active_protections(apart_run, monkeypatch):
    text = "def fit(number): return {}\n"
    assert apart_run(text).level == LEVEL
    monkeypatch.setattr(sandbox_parent, "LANDLOCK_ABI", 4)
    if landlock.find_abi_version() > 4:
        assert apart_run(text).level.startswith("isolated (Landlock ABI 4, ")
    monkeypatch.setattr(sandbox_parent, "CONFINED", False)

    assert apart_run(text).level.startswith("limited: time")
    assert apart_run(text).level.endswith("it can read files and reach the network")


DEEP = """import os
def fit(number):
    for level in range(1500):
        open("file", "w").close()
        os.symlink("/", "link") if number else None
        os.mkdir("d", 0o700)
        os.chdir("d")
    return {"a": 1.0}
"""


@pytest.mark.usefixtures("each_level")
def test_folder_1500_levels_deep_is_removed(apart_run, monkeypatch, tmp_path):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    (answer,) = apart_run(DEEP).answers

    assert dict(answer.numbers) == {"a": 1.0}
    assert [file.name for file in tmp_path.iterdir()] == ["fit.py"]


@posix
def test_a_link_in_what_is_removed_is_not_followed(tmp_path):
    kept, scratch = tmp_path / "kept", tmp_path / "scratch"
    (kept / "in").mkdir(parents=True)
    (scratch / "a" / "b").mkdir(parents=True)
    (scratch / "a" / "b" / "link").symlink_to(kept)
    (scratch / "a" / "b" / "closed").mkdir(mode=0)
    remove_tree(scratch)

    assert not scratch.exists()
    assert (kept / "in").is_dir()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux tells a child")
def test_child_ends_when_its_parent_ends(tmp_path):
    source = tmp_path / "fit.py"
    source.write_text("import time\ndef fit():\n    time.sleep(3600)\n", encoding="utf-8")
    program = (
        "import sys; from pathlib import Path; "
        "from grader.isolation import FunctionCall, Limits, run_functions; "
        "run_functions(Path(sys.argv[1]), calls=[FunctionCall('fit')], limits=Limits(seconds=600))"
    )
    parent = psutil.Popen([sys.executable, "-c", program, str(source)], cwd=ROOT)
    last = time.monotonic() + 60
    while not (children := parent.children()) or not _waits(children[0]):
        assert time.monotonic() < last
        time.sleep(0.05)
    time.sleep(1.0)
    parent.kill()
    parent.wait()

    _, alive = psutil.wait_procs(children, timeout=20)
    assert alive == []


def _waits(process):
    return process.status() == psutil.STATUS_SLEEPING


@pytest.mark.parametrize("machine", seccomp.TABLES)
def test_filter_prevents_slowing_another_process_down(machine):
    table = seccomp.TABLES[machine]

    assert len(table.own) == 7
    for number in table.own:
        assert verdict(table, number, 1) == seccomp.REFUSE
        assert verdict(table, number, 0) == seccomp.ALLOW


def test_learner_code_may_use_threads(apart_run):
    code = "import threading\nt = threading.Thread(target=print)\nt.start()\nt.join()"

    assert dict(apart_run(attempt(code)).answers[0].numbers) == {"worked": 1.0}


def test_sandboxed_run_leaves_no_files_behind(apart_run, monkeypatch, tmp_path):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    apart_run("import os\ndef fit(number):\n    os.mkdir('a', 0)\n    open('b', 'w').write('c')\n")

    assert [file.name for file in tmp_path.iterdir()] == ["fit.py"]
