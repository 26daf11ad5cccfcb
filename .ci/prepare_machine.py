"""Prepare a machine for the gate: install what tests need beside Python, where it is allowed.

Without these programs the tests that need them are skipped.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

NODE = Path(__file__).resolve().parents[1] / "build" / "node"
PACKAGES = {"axe-core@4": "the tests of accessibility"}  # of npm, and what is skipped without it
if sys.platform == "linux" and os.geteuid() == 0:  # elsewhere the Hub's test is skipped
    PACKAGES["configurable-http-proxy@5"] = "the test of JupyterHub"


def main() -> None:
    """Install each program that is missing."""
    install_program(
        ("chromium", "chromium-browser", "google-chrome", "chrome"),
        package="chromium",
        tests="browser tests",
    )
    install_program(("javac",), package="default-jdk-headless", tests="tests that compile Java")
    npm = shutil.which("npm")
    for package, tests in PACKAGES.items():
        if npm and not list(NODE.glob(f"lib/node_modules/{package.partition('@')[0]}")):
            print(f"installing {package} for {tests}")
            command = [npm, "install", "--silent", "--global", f"--prefix={NODE}", package]
            subprocess.run(command, check=False)


def install_program(names: tuple[str, ...], *, package: str, tests: str) -> None:
    """Install a program with apt, if it is not there.

    Args:
        names: what the program may be called.
        package: the Debian package that has it.
        tests: which tests are skipped without it.
    """
    if any(map(shutil.which, names)):
        return
    apt = shutil.which("apt-get")
    if not apt or os.geteuid() != 0:
        print(f"no {names[0]} here and no way to install one: {tests} will be skipped")
        return
    print(f"installing {package} for {tests}")
    for step in ("update -q", f"install -q -y --no-install-recommends {package}"):
        subprocess.run(
            [apt, *step.split()],
            check=True,
            stdout=subprocess.DEVNULL,
            env=os.environ | {"DEBIAN_FRONTEND": "noninteractive"},
        )


if __name__ == "__main__":
    main()
