"""JupyterLab over a copy of the lessons, and what a learner does in it: run all, turn a knob."""

import contextlib
import json
import os
import secrets
import shutil
import subprocess
import sys
import time

from places import ROOT

LESSONS = sorted((ROOT / "lessons").glob("*.ipynb"))
SETTINGS = {
    "apputils-extension/notification": {"fetchNews": "false", "checkForUpdates": False},
    "notebook-extension/tracker": {"windowingMode": "none"},  # every cell is in the page
}
SCREEN = {"width": 1280, "height": 900}
PATIENCE = 60_000  # [ms] for anything to appear, on a busy machine
OFTEN = 100  # [ms] between two looks; a page that nobody sees draws no frames to wait for


@contextlib.contextmanager
def serving(home):
    """Fresh JupyterLab on a free local port, over a copy of the lessons: its address."""
    (home / "lessons").mkdir()
    for notebook in LESSONS:
        shutil.copy(notebook, home / "lessons")
    for name, setting in SETTINGS.items():
        path = home / "settings" / "@jupyterlab" / f"{name}.jupyterlab-settings"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(setting), encoding="utf-8")
    token = secrets.token_hex(16)
    with (home / "lab.log").open("wb") as log:
        server = subprocess.Popen(
            _command(home, token), env=make_environment(home), stdout=log, stderr=log
        )
    try:
        yield f"http://127.0.0.1:{_port(home, server)}/lab/tree/{{name}}?reset&token={token}"
    finally:
        server.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            server.wait(timeout=20)
        server.kill()
        server.wait()


def open_notebook(page, address):
    """Open a notebook, and wait until its kernel is there."""
    page.goto(address)
    wait_until_idle(page)


def wait_until_idle(page):
    """Wait until the kernel of the notebook is there, and runs nothing."""
    page.locator("#jp-main-statusbar").get_by_text("| Idle").wait_for()


def choose_run_all(page):
    """Choose Run > Run All Cells."""
    page.locator(".lm-MenuBar-itemLabel", has_text="Run").first.click()
    page.locator(".lm-Menu-itemLabel").get_by_text("Run All Cells", exact=True).click()


def run_all(page, address):
    """Open a notebook, choose Run > Run All Cells, and wait until the last cell is done."""
    open_notebook(page, address)
    choose_run_all(page)
    page.wait_for_function(
        """() => {
            const shown = '.jp-CodeCell .jp-InputPrompt:not(.jp-Placeholder-prompt)';
            const prompts = [...document.querySelectorAll(shown)]
                .map(prompt => prompt.textContent.trim());
            return prompts.length && prompts.every(text => /^\\[\\d+\\]:$/.test(text));
        }""",
        polling=OFTEN,
    )
    wait_until_idle(page)


def outputs(page, kind):
    """The texts of all outputs of a kind: ``error``, ``stderr``."""
    where = f'[data-mime-type="application/vnd.jupyter.{kind}"]'
    return page.locator(where).all_inner_texts()


def _command(home, token):
    return [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--allow-root",
        "--ip=127.0.0.1",
        "--port=0",
        f"--IdentityProvider.token={token}",
        f"--ServerApp.root_dir={home / 'lessons'}",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
        "--LabApp.extension_manager=readonly",
    ]


def make_environment(home):
    """Everything Jupyter writes goes below ``home``; the project can be imported."""
    paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
    return os.environ | {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_DATA_DIR": str(home / "data"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
        "JUPYTERLAB_SETTINGS_DIR": str(home / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(home / "workspaces"),
        "IPYTHONDIR": str(home / "ipython"),
    }


def _port(home, server):
    """Where the server listens, once it does."""
    deadline = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < deadline and server.poll() is None:
        for path in (home / "runtime").glob("jpserver-*.json"):
            with contextlib.suppress(json.JSONDecodeError):  # it is just being written
                return json.loads(path.read_text(encoding="utf-8"))["port"]
        time.sleep(0.1)
    log = (home / "lab.log").read_text(encoding="utf-8", errors="replace")
    raise RuntimeError(f"JupyterLab did not start:\n{log}")
