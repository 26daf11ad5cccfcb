"""The lessons: notebook and text agree, every cell runs clean, every picture speaks."""

import ast
import io
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser

import nbformat
import numpy as np
import pytest
from ci_scripts import load_script
from jupyter_client.kernelspec import KernelSpecManager
from matplotlib.image import imread
from PIL import Image
from places import ROOT

import grader
import sim
from grader.classroom.edition import PAGE, SLIDES, VIEW, convert_notebook, execute_notebook
from grader.robotcode.library import revlib
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.physics.motors import MOTORS
from sim.plot.animation.charts import Chart, Curve
from sim.teaching.answers import read_answer
from sim.teaching.r2_cases import GOOD, make_cases

TEXTS = sorted((ROOT / "lessons").glob("*.py"))
PLUMBING = (  # what a cell in sight does not do
    r"^(?:import|from) |\b(?:ask_question|animate_charts|animate_mechanism)\("
)
LARGEST = 40_000  # [bytes] of a picture
SAME = 0.002  # [1] mean difference of two drawings of one picture
MOVING = 3  # figures of a lesson, at least
SCREENFUL = 40  # [lines] of a function; what is longer belongs into sim
DERIVE = "run  python .ci/derive_notebooks.py  and commit the notebook with its text"

# Windows' event loop cannot watch sockets; the library below nbclient helps itself, and says so.
pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore:Proactor event loop:RuntimeWarning"),
]

each_lesson = pytest.mark.parametrize("text", TEXTS, ids=lambda path: path.stem)


def list_questions(text):
    """The questions of a lesson, as the package keeps them."""
    kept = read_answer(f"lesson{int(text.stem[:2])}").values()
    return [one for one in kept if "question" in one]


class Page(HTMLParser):
    """The pictures and the open-and-close of details in a piece of HTML."""

    def __init__(self, html):
        super().__init__()
        self.pictures, self.animations, self.open, self.summaries = [], [], 0, 0
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        """Note a picture, and what opens."""
        if tag == "img":
            self.pictures.append(dict(attrs))
        if tag == "figure" and "data-motion" in dict(attrs):
            self.animations.append(dict(attrs))
        self.open += tag == "details"
        self.summaries += tag == "summary"

    def handle_endtag(self, tag):
        """Note what closes."""
        self.open -= tag == "details"


@pytest.fixture(scope="module")
def derive():
    """The function of the script that derives notebooks."""
    return load_script("derive_notebooks").derive


@pytest.fixture(scope="module")
def run():
    """Run a lesson's notebook as a learner does, once per module, and keep it for the site.

    Warnings are errors.
    """
    assert "python3" in KernelSpecManager().find_kernel_specs(), "install ipykernel"
    site, done = load_script("docs_pages"), {}

    def ran(text):
        if text not in done:
            path = text.with_suffix(".ipynb")
            done[text] = execute_notebook(path)
            site.keep_notebook(done[text], path)
        return done[text]

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONWARNINGS", "error")
        yield ran


def test_every_lesson_has_a_text_and_a_notebook():
    assert [text.stem for text in TEXTS] == [
        notebook.stem for notebook in sorted((ROOT / "lessons").glob("*.ipynb"))
    ]
    assert TEXTS


@each_lesson
def test_notebook_equals_its_derivation_from_the_text(text, derive):
    path = text.with_suffix(".ipynb")
    assert path.exists(), f"{path.name} is missing: {DERIVE}"
    got, says = (
        [(cell.cell_type, cell.source, cell.get("attachments")) for cell in notebook.cells]
        for notebook in (nbformat.read(path, 4), derive(text))
    )
    assert got == says, f"{path.name} is not what {text.name} says: {DERIVE}"


@each_lesson
def test_a_lesson_begins_with_a_picture_that_its_page_and_its_slides_show(text):
    notebook = nbformat.read(text.with_suffix(".ipynb"), 4)
    title = next(cell for cell in notebook.cells if cell.cell_type == "markdown")
    head, _, _ = title.source.partition("**At the end you can**")

    assert title.source.startswith("# ")
    words = "".join(re.findall(r"!\[([^]]+)\]\(attachment:picture\.png\)", head))
    assert len(words) > 40, "the head needs ![what one sees](attachment:picture.png) once"
    for template in (PAGE, SLIDES):
        shown = Page(convert_notebook(notebook, template)).pictures[0]
        assert shown["alt"].split() == words.split()
        assert shown["src"].startswith("data:image/png;base64,")


def test_the_pictures_of_lessons_are_what_their_command_draws():
    script = load_script("draw_lessons")
    for text, made in zip(TEXTS, script.draw_lessons(), strict=True):
        path = ROOT / ".ci" / "pictures" / f"{text.stem}.png"
        kept, drawn = (imread(file) for file in (path, io.BytesIO(made)))

        assert path.stat().st_size < LARGEST
        assert kept.shape == drawn.shape
        with Image.open(path) as picture:
            assert getattr(picture, "is_animated", False) == (text == TEXTS[0])
        # Another processor may move a curve by a pixel.
        assert np.abs(kept - drawn).mean() < SAME, f"{path.name}: run  python .ci/draw_lessons.py"


@each_lesson
def test_deriving_a_notebook_twice_gives_the_same_notebook(text, derive):
    assert nbformat.writes(derive(text)) == nbformat.writes(derive(text))


@each_lesson
def test_a_committed_notebook_holds_no_outputs(text):
    for cell in nbformat.read(text.with_suffix(".ipynb"), 4).cells:
        if cell.cell_type == "code":
            assert not cell.outputs
            assert cell.execution_count is None


@each_lesson
def test_every_cell_runs_without_error_or_warning(text, run):
    for cell in run(text).cells:
        for output in cell.get("outputs", []):
            assert output.get("name") != "stderr", f"{output.text}\n{cell.source}"


@each_lesson
def test_every_question_is_on_a_slide(text, run):
    notebook = run(text)
    slides = unescape(convert_notebook(notebook, SLIDES))
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    shown = [output.data for cell in code for output in cell.outputs if "data" in output]
    widgets = [data["text/plain"] for data in shown if VIEW in data]
    questions = [words for words in widgets if not words.startswith("EffectSearch(")]
    starts = [re.sub(r"{.*", "", one["question"]) for one in list_questions(text)]

    assert [start for start in starts if not any(q.startswith(start) for q in questions)] == []
    assert [words for words in questions if f">{words}</pre>" not in slides] == []


@each_lesson
def test_every_picture_has_words_and_draws_only_on_white(text, run):
    pages = [Page(html) for html in _htmls(run(text))]
    assert any(page.pictures or page.animations for page in pages), (
        "no cell shows a picture: call a function of sim.plot"
    )
    for picture in (picture for page in pages for picture in page.pictures):
        assert len(picture["alt"]) > 40
        assert picture["src"].startswith("data:image/svg+xml;base64,")
        assert "background:white" in picture["style"]


@each_lesson
def test_every_animation_has_a_description(text, run):
    for html in _htmls(run(text)):
        for animation in Page(html).animations:
            assert len(animation["aria-label"]) > 40
            assert animation["aria-label"].endswith(".")


@each_lesson
def test_a_lesson_has_three_figures_that_move_without_the_kernel(text, run):
    """The page itself draws them whenever a menu, a slider or the time changes."""
    pages = [Page(html) for html in _htmls(run(text))]
    moving = sum(len(page.animations) for page in pages)
    assert moving >= MOVING, f"{moving} figures are by sim.plot.animation, and {MOVING} have to be"


@each_lesson
def test_every_detail_is_closed_and_has_a_summary(text):
    for cell in nbformat.read(text.with_suffix(".ipynb"), 4).cells:
        if cell.cell_type == "markdown":
            page = Page(cell.source)
            assert page.open == 0, cell.source
            assert page.summaries == cell.source.count("<details>")


@each_lesson
def test_a_lesson_has_the_anatomy_of_the_source_lesson(text):
    headings = re.findall(r"^# ## (?:\d+ )?(.+)$", text.read_text(encoding="utf-8"), re.MULTILINE)
    assert headings[0].startswith("Why")
    missing = {"System check", "Knowledge check", "Practice"} - {*headings}
    assert not missing, f"{text.name} has no section {missing}"


@pytest.mark.shared
@each_lesson
def test_quotes_are_in_the_source_lesson(text, shared):
    source = _plain((shared / "source-lesson.md").read_text(encoding="utf-8"))
    for quote in re.findall(r"(?:^# >.*\n)+", text.read_text(encoding="utf-8"), re.MULTILINE):
        words = _plain(re.sub(r"^# > ?", "", quote, flags=re.MULTILINE))
        claim = words.partition("**Lessonsays:**")[2].partition("**Sourcesays:**")[0]
        for said in re.findall(r'"([^"]+)"', claim):
            for part in said.rstrip(".").split("…"):
                assert part in source, said


@each_lesson
def test_a_lesson_links_to_the_next_one(text):
    source = text.read_text(encoding="utf-8")
    later = [other.with_suffix(".ipynb").name for other in TEXTS if other > text]
    assert "**Next:**" in source, f"{text.name} ends with **Next:**"
    if later:
        told = f"{text.name} links to {later[0]} after **Next:**"
        assert f"]({later[0]})" in source.partition("**Next:**")[2], told


@each_lesson
def test_the_practice_of_a_lesson_links_to_its_exercises_and_names_grade_watch(text):
    practice = text.read_text(encoding="utf-8").rpartition("Practice\n#\n")[2]
    named = set(re.findall(r"grade (exercise\d+|practice)\b", practice)) - {"practice"}
    linked = set(re.findall(r"\]\(\.\./exercises/(\w+)/README\.md\)", practice))

    assert linked - {"practice"} == named, "Practice links to the exercises that it grades"
    assert "`grade watch exercise" in practice, "Practice names `grade watch exerciseN`"


def run_cell(number, begin, **space):
    """What a cell of a lesson defines, from where it begins, run with the given names."""
    (text,) = (path for path in TEXTS if path.stem.startswith(number))
    _, _, source = text.read_text(encoding="utf-8").partition(begin)
    exec(begin + source.partition("# %%")[0], space)  # noqa: S102 - the lesson's own cell
    return space


@pytest.mark.robot
def test_wpilibs_simulation_with_the_gains_and_without_ks_differs_from_the_log_by_the_noise():
    simulation = pytest.importorskip("wpilib.simulation", reason="RobotPy is not installed")
    plant = pytest.importorskip("wpimath.system.plant")
    names = {"FlywheelSim": simulation.FlywheelSim, "DCMotor": plant.DCMotor}
    names |= {"LinearSystemId": plant.LinearSystemId, "np": np, "sim": sim}
    spin = run_cell("09", "def spin_in_wpilib", **names)["spin_in_wpilib"]
    wheel = sim.MECHANISMS["shooter"]
    log = simulate(wheel, sim.Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(1))
    gains = fit(log).gains

    for run in log.runs:
        with_friction, without = (
            float(np.std(spin(gains, run, friction) - run.velocity))
            for friction in (gains["kS"], 0.0)
        )
        assert with_friction < 1.1 * wheel.sensor.velocity_noise, run.test
        assert abs(np.mean(spin(gains, run, 0.0)[-20:] - run.velocity[-20:])) > 0.8 * (
            gains["kS"] / gains["kV"]
        ), run.test
        assert without >= with_friction


@pytest.mark.robot
def test_an_elevator_in_wpilibs_simulation_falls_at_its_own_gravity_whatever_kg_is():
    simulation = pytest.importorskip("wpilib.simulation", reason="RobotPy is not installed")
    plant = pytest.importorskip("wpimath.system.plant")
    gains = sim.MECHANISMS["counterweight-elevator"].gains
    system = plant.LinearSystemId.identifyPositionSystemMeters(gains["kV"], gains["kA"])
    lift = simulation.ElevatorSim(system, plant.DCMotor.NEO(1), 0.0, 2.0, True, 1.0)  # noqa: FBT003
    lift.setInputVoltage(0.0)
    lift.update(0.001)

    assert lift.getVelocity() / 0.001 == pytest.approx(-9.8, rel=0.02)
    assert gains["kG"] / gains["kA"] < 0.5 * 9.8


def test_gains_in_amperes_are_those_in_volts_over_the_resistance_and_no_kv():
    wheel = sim.MECHANISMS["shooter"]
    gains, resistance = wheel.gains, 12.0 / wheel.motor.stall_current
    routine = sim.Routine(step=2.0, timeout=3.0, kinds=("dynamic",))
    log = simulate(wheel, routine, rng=np.random.default_rng(1), electrical=True)

    for run in log.runs:
        volts, speed = np.abs(run.voltage), np.abs(run.velocity)
        speeds_up = (volts - gains["kS"] - gains["kV"] * speed) / gains["kA"]
        amperes = (gains["kS"] + gains["kA"] * speeds_up) / resistance
        noise = gains["kV"] * wheel.sensor.velocity_noise / resistance
        assert np.std(np.abs(run.current) - amperes) == pytest.approx(noise, rel=0.2)
        steady = np.abs(run.current[-20:]).mean()  # at full speed, and no kV·v in it
        assert steady == pytest.approx(gains["kS"] / resistance, rel=0.01)
        assert round(steady, 1) == 3.7


def test_rows_every_20_ms_show_the_kv_of_a_light_steering_and_not_its_ka():
    wheel = sim.MECHANISMS["shooter"]
    light = replace(wheel, load=wheel.load / 30)
    routine = sim.Routine(ramp=1.0, step=3.0)
    found = fit(simulate(light, routine, rng=np.random.default_rng(1)), method="sysid").gains

    assert found["kV"] == pytest.approx(light.gains["kV"], rel=0.01)
    assert found["kA"] > 2.0 * light.gains["kA"]


def test_the_default_of_motion_magic_expo_is_a_kraken_without_gears():
    assert MOTORS["krakenX60"].back_emf * 2 * math.pi == pytest.approx(0.12, rel=0.01)


def test_a_spark_with_voltage_compensation_takes_a_duty_cycle_as_a_share_of_12_volts():
    motor = revlib.CANSparkBase(1, revlib.MotorType.kBrushless)
    asked = {}
    for nominal in (0.0, 12.0):
        motor.enableVoltageCompensation(nominal)
        motor.set(0.3)
        asked[nominal] = (motor._command.kind, motor._command.value)

    assert asked == {0.0: ("duty", 0.3), 12.0: ("voltage", pytest.approx(3.6))}


def test_lesson_6_does_not_name_the_damage_of_a_log_before_one_decided():
    source = (ROOT / "lessons" / "06_read_the_data.py").read_text(encoding="utf-8")
    cell = source.partition("# **Decide first:**")[2].partition("# %%\n")[2].partition("# %%")[0]
    cases = make_cases(rng=np.random.default_rng(0))
    space = {"np": np, "all_cases": cases, "GOOD": GOOD, "Chart": Chart, "Curve": Curve}
    space["TRUTH"] = {"kS": 0.15, "kV": 2.5, "kA": 0.2}
    exec(cell.partition("animate_charts(")[0], space)  # noqa: S102 - the lesson's own cell
    for sort in space["KEYS"]:
        for chart in space["grid"]("hide", sort):
            assert sorted(chart.rows) == [chr(ord("A") + at) for at in range(len(cases))]
            assert not [curve.name for curve in chart.curves if curve.name]
    revealed = " ".join(space["grid"]("reveal", "letter")[0].rows)
    assert all(case.name in revealed for case in cases)
    by_letter = [space["LETTERS"][case.name] for case in cases]
    assert by_letter != sorted(by_letter)  # the order in which they are made would tell


def test_lesson_6_names_the_faults_as_exercise_7_and_inspect_do():
    from sim.inspect.faults import FAULTS  # noqa: PLC0415 - only here

    source = (ROOT / "lessons" / "06_read_the_data.py").read_text(encoding="utf-8")
    gallery = source.partition("gallery = {")[2].partition("}\n")[0]
    own = {"clean", "velocity-filter", "current-limit"}  # physics, and no fault of the record
    names = {
        name.replace(" ", "-") for name in re.findall(r'^    "([a-z ]+)":', gallery, re.MULTILINE)
    }
    assert names - own <= {*FAULTS}
    assert len(names - own) >= 11


@each_lesson
def test_no_code_of_a_lesson_holds_a_right_answer(text):
    """Neither in sight nor in a collapsed cell, which a click opens."""
    answers = {one["right"] for one in list_questions(text) if " " in str(one.get("right"))}
    tree = ast.parse(text.read_text(encoding="utf-8"))
    said = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)}

    assert answers, "no question of lesson_answers.toml has a right answer of several words"
    assert answers & said == set()


@each_lesson
def test_visible_code_of_a_lesson_is_short(text):
    """In sight is what one reads or writes; folded is what imports, asks, and draws widgets."""
    cells = nbformat.read(text.with_suffix(".ipynb"), 4).cells
    in_sight = []
    for cell in cells:
        if cell.cell_type == "code" and not cell.metadata.get("jupyter", {}).get("source_hidden"):
            assert not re.search(PLUMBING, cell.source, re.MULTILINE), cell.source
            in_sight.append([line for line in cell.source.splitlines() if line.strip()])

    assert in_sight, "no cell has code in sight: one that imports, asks or shows a widget is folded"
    assert max(map(len, in_sight)) <= 12
    assert sum(map(len, in_sight)) <= 60
    for cell in cells:
        if cell.cell_type == "code" and re.search(r"(?:return|=) \.\.\.", cell.source):
            assert "jupyter" not in cell.metadata, f"the learner writes here:\n{cell.source}"


@each_lesson
def test_a_lesson_uses_only_public_names_and_short_functions(text):
    for node in ast.walk(ast.parse(text.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            names = {name.name for name in node.names}
            assert not node.module.startswith("grader.")
            assert node.module != "grader" or names <= {*grader.__all__}
            assert not [name.name for name in node.names if name.name.startswith("_")]
        if isinstance(node, ast.Attribute):
            assert not node.attr.startswith("_")
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < SCREENFUL, node.name


def program(text, *, folder, home):
    """What a lesson prints when it is run as a plain program."""
    done = subprocess.run(
        [sys.executable, str(text)],
        cwd=folder,
        env=_environment(home),
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_lesson_7_reads_the_log_that_exercise_9_made(tmp_path, root):
    lessons, data = tmp_path / "lessons", tmp_path / "exercises" / "exercise9" / "data" / "ada"
    lessons.mkdir()
    data.mkdir(parents=True)
    log = simulate(sim.MECHANISMS["shooter"], sim.Routine(), rng=np.random.default_rng(5))
    sim.write(log, data / "log.wpilog")

    said = program(root / "lessons" / "07_fit_it_yourself.py", folder=lessons, home=tmp_path)

    assert "ada" in said
    assert "in rotations" in said


def _plain(text):
    """Text without code marks, and without spaces, of which the source lesson lost some."""
    return "".join(text.replace("`", "").split())


def _htmls(notebook):
    """All HTML that a run notebook shows, in outputs and in widgets."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if "text/html" in output.get("data", {}):
                yield output.data["text/html"]
    widgets = notebook.metadata.get("widgets", {})
    for model in widgets.get("application/vnd.jupyter.widget-state+json", {}).get("state", {}):
        state = widgets["application/vnd.jupyter.widget-state+json"]["state"][model]["state"]
        if isinstance(state.get("value"), str):
            yield state["value"]


def _environment(home):
    """The project can be imported, and nothing is written into the person's home."""
    paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
    return os.environ | {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "PYTHONIOENCODING": "utf-8",
        "IPYTHONDIR": str(home / "ipython"),
    }
