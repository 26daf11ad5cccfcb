"""``grade class --in docker``: the same command in a container without network, as on Linux.

The container reads the course, what was handed in, the roster and the secret's file, and writes
the output folder; nothing else of this machine is there. It runs an image that holds Python and
what the course needs, made once, in the course folder (this module prints DOCKERFILE):

    python -m grader.classroom.container | docker build -t sysid-course -f - .
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import click

from sim.core.errors import BadRequest
from sim.support.command_line import INTERRUPTED
from sim.support.secret import VARIABLE

ENGINES = ("docker", "podman")
IMAGE = "sysid-course"
DOCKERFILE = """\
FROM python:3.12-slim
RUN --mount=type=bind,target=/build,rw \\
    pip install --no-cache-dir "/build[course,robot]" && pip uninstall -y sysid-course
"""
BUILD = f"python -m grader.classroom.container | {{engine}} build -t {IMAGE} -f - ."
ENGINE_FAILED = (125, 126, 127)  # what docker and podman return when nothing was started
ANSWERS_WITHIN = 10.0  # [s] for an engine that is asked whether it is there
HERE_ONLY = frozenset({"engine", "image", "output"})  # options that the command inside is not given


def grade_in_container(context: click.Context, *, course: Path, output: Path) -> int:
    """Run the same ``grade class`` command in a container; its exit code.

    Args:
        context: of the command, with its options; ``engine`` and ``image`` are among them.
        course: the course folder.
        output: where results go.

    Raises:
        BadRequest: the engine is not installed, does not answer or lacks the image.
    """
    engine, image = str(context.params["engine"]), str(context.params["image"])
    if context.params.get("cluster"):
        raise BadRequest(
            "--in and --cluster cannot be used together",
            advice="A container has no network. Leave one of the two out.",
        )
    program = shutil.which(engine)
    if program is None:
        raise BadRequest(f"{engine} is not installed", advice=f"Install {engine}, then try again.")
    output.mkdir(parents=True, exist_ok=True)
    words = [program, *build_container_arguments(context, course=course, output=output)]
    try:
        code = subprocess.run(words, check=False).returncode  # noqa: S603 - a list, no shell
    except KeyboardInterrupt:
        return INTERRUPTED
    if code in ENGINE_FAILED:
        raise BadRequest(
            f"{engine} could not start the image {image!r}; it says why above",
            advice=f"Start {engine}; if the image is missing, in the course folder: "
            f"{BUILD.format(engine=engine)}",
        )
    return code


def build_container_arguments(context: click.Context, *, course: Path, output: Path) -> list[str]:
    """The words after ``docker``: no network, nothing writable but the output folder."""
    engine, given = context.params["engine"], context.params
    mounts = [_format_mount(course, "/course"), _format_mount(output, "/out", write=True)]
    words = ["class"]
    for parameter in context.command.params:
        name = str(parameter.name)
        if name in HERE_ONLY or parameter.is_eager:
            continue
        value = given.get(name)
        if isinstance(parameter.type, click.Path) and value is not None:
            inside = f"/given/{name}/{value.resolve().name}"
            mounts.append(_format_mount(value, inside))
            value = inside
        words += _format_option(parameter, value)
    own = ["--security-opt", "label=disable"] if engine == "podman" else []
    if sys.platform != "win32":
        user = ["--user", f"{os.getuid()}:{os.getgid()}"]
        own += ["--userns", "keep-id"] if engine == "podman" else user
    return [
        *("run", "--rm", "--init", "--network", "none", "--read-only", "--tmpfs", "/tmp"),  # noqa: S108 - the container's own
        *("--cap-drop", "ALL", "--security-opt", "no-new-privileges", *own),
        *("--env", "HOME=/tmp", "--env", "PYTHONDONTWRITEBYTECODE=1", "--env", VARIABLE),
        *(word for mount in mounts for word in ("--mount", mount)),
        *("--workdir", "/course", str(given["image"]), "python", "-m", "grader"),
        *(*words, "--output", "/out"),
    ]


def _format_mount(path: Path, target: str, *, write: bool = False) -> str:
    source = path.resolve()
    if "," in str(source) or '"' in str(source):
        raise BadRequest(
            "a container cannot use a path with a comma or a quotation mark",
            where=str(source),
            advice="Rename that folder.",
        )
    return f"type=bind,source={source},target={target}{'' if write else ',readonly'}"


def _format_option(parameter: click.Parameter, value: Any) -> Iterator[str]:  # noqa: ANN401 - whatever an option holds
    """An option or argument with its value, as typed; empty if it was not given."""
    if value is None or (value is False and not parameter.secondary_opts):
        return
    if not isinstance(parameter, click.Option):
        yield str(value)
    elif parameter.is_flag:
        yield (parameter.opts if value else parameter.secondary_opts)[-1]
    else:
        for one in value if parameter.multiple else (value,):
            yield from (parameter.opts[-1], str(one))


def find_engines() -> list[str]:
    """The engines that answer on this machine."""
    found = []
    for engine in ENGINES:
        with suppress(OSError, subprocess.SubprocessError):
            subprocess.run(  # noqa: S603 - a list, no shell
                [engine, "info"], capture_output=True, timeout=ANSWERS_WITHIN, check=True
            )
            found.append(engine)
    return found


if __name__ == "__main__":
    sys.stdout.write(DOCKERFILE)
