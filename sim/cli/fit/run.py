"""What ``sysid fit`` does: fit, check, print, and write files."""

import json
import math
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import click

from sim.cli.fit.command import LOOPS
from sim.cli.fit.inertia import add_inertia, read_turning
from sim.cli.fit.layout import choose_layout_path
from sim.cli.fit.parts import PooledParts, fit_parts
from sim.cli.fit.paste import make_paste_text
from sim.cli.fit.plausibility import (
    check_against_physics,
    compare_directions_alone,
    read_motor_parts,
)
from sim.cli.log_reader import LogReader, Parts, join_parts
from sim.cli.options import refuse_overwriting
from sim.core.leave_out import LeftOutPart, leave_out
from sim.core.log import Log
from sim.core.units import find_unit
from sim.feedback import PRESETS, Feedback
from sim.fit import Fit
from sim.fit import fit as find_gains
from sim.fit.between_recordings import describe_next_recording
from sim.fit.feedback_trial import (
    OWN,
    FeedbackTrial,
    OwnGains,
    format_gain_pair,
    try_feedback_gains,
    warn_of_bad_suggestions,
)
from sim.fit.physics.inertia import MomentOfInertia
from sim.support.command_line import DONE, NOT_RIGHT


def fit_files(  # noqa: PLR0917 - click passes options by name
    ctx: click.Context,
    /,
    files: tuple[Path, ...],
    reader: LogReader,
    method: str,
    median: int,
    preset: str,
    driven_by: str | None,
    count: int,
    ratio: float | None,
    radius: float,
    load: float | None,
    left_out: tuple[str, ...],
    straight: Path | None,
    mass: float | None,
    lever: float | None,
    paste: str | None,
    season: str,
    own_kp: float | None,
    own_kd: float | None,
    loop: str | None,
    html: Path | None,
    plot: Path | None,
    wpilog: Path | None,
    as_json: bool,  # noqa: FBT001 - click passes it by name
) -> int:
    """Fit the logs in some files, and print and write what the options of ``sysid fit`` say.

    Returns:
        The exit code.

    Raises:
        Refusal: a file cannot be read, fitted or written.
    """
    own = _read_own_gains(ctx, loop, kp=own_kp, kd=own_kd)
    built = read_motor_parts(driven_by, count=count, ratio=ratio, radius=radius, load=load)
    gone = tuple(map(LeftOutPart.parse, left_out))
    turning = read_turning(straight, mass=mass, lever=lever)
    complete = reader.read_parts(files)
    parts = leave_out(complete, gone)
    log = join_parts(parts)
    find = partial(find_gains, type=reader.type or "", method=method, median=median)
    pooled = fit_parts(parts, find, files=len(files))
    notes = (*pooled.notes, *(f"Left out: {part}." for part in gone))
    found, notes = check_against_physics(pooled.found, log, parts=built, notes=notes)
    if not (as_json or paste):
        found, notes = compare_directions_alone(found, log, notes, include_long=html is not None)
    found, notes, turned = add_inertia(found, notes, log, turning, method=method)
    if len(files) == 1:
        notes = (*notes, *describe_next_recording(found))
    tried = try_feedback_gains(found := found.in_log_units(), PRESETS[preset], own=own)
    found = replace(found, doubts=(*found.doubts, *warn_of_bad_suggestions(found, tried)))
    output = _FitOutput(files, found, log, preset, tried, notes, pooled, turned)
    _write_files(output, plot=plot, wpilog=wpilog, parts=parts)
    if html is not None:
        _write_page(output, html, complete, gone)
    return output.echo(as_json=as_json, paste=paste, season=int(season))


@dataclass(frozen=True, eq=False)
class _FitOutput:
    """The fit, and everything that is printed or written with it."""

    files: tuple[Path, ...]
    found: Fit
    log: Log
    preset: str
    tried: tuple[FeedbackTrial, ...]
    notes: tuple[str, ...]
    pooled: PooledParts
    turned: MomentOfInertia | None = None

    def echo(self, *, as_json: bool, paste: str | None, season: int) -> int:
        """Print robot code, JSON or readable text, as the options say; the exit code."""
        if paste:
            click.echo(make_paste_text(self.found, paste, season=season), nl=False)
        elif as_json:
            click.echo(json.dumps(self.to_json(), allow_nan=False))
        else:
            self.print_result()
        return NOT_RIGHT if any(doubt.grave for doubt in self.found.doubts) else DONE

    def to_json(self) -> dict[str, object]:
        """The fit as plain data, with the user's own gains and those of parts if there are any."""
        own = [
            {"loop": one.loop, "kP": one.gains.kp, "kD": one.gains.kd, **one.verdict.to_json()}
            for one in self.tried
            if one.owner == OWN
        ]
        data = self.found.to_json(PRESETS[self.preset])
        data |= {"own_feedback": own[0]} if own else {}
        data |= {"moment_of_inertia": self.turned.to_json()} if self.turned else {}
        parts = self.pooled.to_json()
        return data | ({"parts": parts} if parts else {})

    def print_result(self) -> None:
        """Print the fit on the terminal."""
        from sim.report.fit_terminal import show_fit  # noqa: PLC0415 - JSON needs no terminal

        show_fit(
            self.found, preset=PRESETS[self.preset], title=", ".join(map(str, self.files)),
            log=self.log, tried=self.tried, notes=self.notes,
        )  # fmt: skip


def _write_files(
    output: _FitOutput, *, plot: Path | None, wpilog: Path | None, parts: Parts
) -> None:
    """Write the files that the options name."""
    if wpilog is not None:
        from sim.cli.fit.wpilog import write_replay  # noqa: PLC0415 - inspects the log

        write_replay(output.found, parts, wpilog)
    if plot is not None:
        from sim.report.fit_picture import write_picture  # noqa: PLC0415 - Matplotlib takes longer than the fit

        write_picture(output.found, output.log, plot)


def _write_page(
    output: _FitOutput, html: Path, complete: Parts, left_out: tuple[LeftOutPart, ...]
) -> None:
    """Write the page of ``sysid open`` as one file."""
    from sim.cli.open.saved_page import save_page  # noqa: PLC0415 - needs all that a page can show
    from sim.cli.open.session import OpenLog, Reading  # noqa: PLC0415 - the same

    # A page travels, and folders are private
    names = ", ".join(file.name for file in output.files)
    one = OpenLog(1, names, output.files[0], finished=complete)
    symbol = find_unit(output.found.units).symbol
    trials = [
        f"With {'your own' if trial.owner == OWN else 'the suggested'} gains "
        f"({format_gain_pair(trial, symbol)}), the {trial.loop} loop {trial.verdict.description}."
        for trial in output.tried
    ]
    pooled = replace(output.pooled, found=output.found, notes=(*output.notes, *trials))
    one.store_fit(reading := Reading(left_out=left_out), pooled)
    save_page(one, reading, html)


def _refuse_conflicting_options(ctx: click.Context) -> None:
    """Refuse options that would be ignored, and outputs that would replace an input."""
    paste, wpilog = ctx.params["paste"], ctx.params["wpilog"]
    layout = None if wpilog is None else choose_layout_path(wpilog)
    refuse_overwriting(
        ctx.params["html"], ctx.params["plot"], wpilog, layout,
        inputs=[*ctx.params["files"], ctx.params["straight"]],
    )  # fmt: skip
    given = ctx.get_parameter_source("preset") is not click.core.ParameterSource.DEFAULT
    if paste and given and ctx.params["preset"] != "default":
        raise click.UsageError(
            "--paste writes gains for WPILib's own PIDController, so --preset would change "
            "nothing. Leave out --paste to see that controller's gains."
        )
    if (
        paste
        and ctx.params["own_kp"] is not None
        and not (ctx.params["html"] or ctx.params["plot"])
    ):
        raise click.UsageError(
            "--paste prints code only, so --own-kp would be tried unseen. Leave out one of them."
        )


def _read_own_gains(
    ctx: click.Context, loop: str | None, *, kp: float | None, kd: float | None
) -> OwnGains | None:
    """The user's own gains, or None; refuses options that would be ignored."""
    _refuse_conflicting_options(ctx)

    if kp is None:
        if kd is None and loop is None:
            return None
        raise click.UsageError("Missing option '--own-kp': --own-kd and --loop need your kP.")
    if not (math.isfinite(kp) and math.isfinite(kd or 0.0)):
        raise click.UsageError("--own-kp and --own-kd are numbers. Give finite ones.")
    return OwnGains(loop or LOOPS[0], Feedback(kp, kd or 0.0))
