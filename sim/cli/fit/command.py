"""``sysid fit``: its options."""

from typing import Any

import click

from sim.cli import fit as work
from sim.cli.options import FILE, as_json, combine_options, paste_options, reading_options
from sim.core.vocabulary import METHODS
from sim.feedback import PRESETS

LOOPS = ("velocity", "position")


# The options for a robot that turns on the spot.
turning_options = combine_options(
    click.option(
        "--straight",
        type=FILE,
        help="If FILES show a robot turning on the spot: a log of this robot driving straight. "
        "The command then prints the moment of inertia.",
    ),
    click.option("--mass", type=float, help="Mass of the robot [kg], for --straight."),
    click.option(
        "--lever",
        type=float,
        help="Distance from the middle of the robot to the line along which a wheel pushes "
        "[m], for --straight: trackwidth/√2 for a square swerve drive, trackwidth/2 for a "
        "tank drive.  [default: computed from the speeds]",
    ),
)
# The user's own feedback gains, which are simulated, too, and the files to write.
feedback_options = combine_options(
    click.option("--own-kp", type=float, help="Also simulate a loop with your own kP."),
    click.option("--own-kd", type=float, help="Your own kD, for --own-kp.  [default: 0]"),
    click.option("--loop", type=click.Choice(LOOPS), help="Loop of --own-kp.  [default: velocity]"),
    click.option("--html", type=FILE, help="Write a page with every figure and number."),
    click.option("--plot", type=FILE, help="Draw all runs into one file: .png, .svg or .pdf."),
    click.option(
        "--wpilog",
        type=FILE,
        help="Write a log with the measured and simulated signals, residual and innovation, "
        "and a layout file for AdvantageScope.",
    ),
)


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@reading_options
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="Our method (simulation) or WPILib SysId's own.",
)
@click.option(
    "--median",
    default=1,
    show_default=True,
    help="Median filter window of SysId's recipe [samples].",
)
@click.option(
    "--preset",
    type=click.Choice(tuple(PRESETS)),
    default="default",
    show_default=True,
    help="Motor controller that the feedback gains are for.",
)
@click.option("--driven-by", metavar="MOTOR", help="Check against theory: krakenX60, neo, …")
@click.option(
    "--count", type=click.IntRange(min=1), default=1, help="Number of motors, for --driven-by."
)
@click.option("--ratio", type=float, help="Motor turns per turn of the output, for --driven-by.")
@click.option(
    "--radius",
    type=float,
    default=1.0,
    help="Radius of wheel or drum [m], for --driven-by and --paste.",
)
@click.option(
    "--load", type=float, help="Moved mass [kg] or moment of inertia [kg·m²], for --driven-by."
)
@click.option(
    "--leave-out",
    "left_out",
    metavar="TEST[:FROM-TO]",
    multiple=True,
    help="Leave out a test, or a part of it in seconds: dynamic-forward:5.5-6; may be repeated.",
)
@turning_options
@paste_options
@feedback_options
@as_json
@click.pass_context
def fit(ctx: click.Context, /, **options: Any) -> Any:  # noqa: ANN401 - passed on
    """Find kS, kV, kA (and kG) in the logs of one mechanism.

    FILES are .wpilog, .csv, or SysId's old .json. Files with one test each are joined. Several
    sides, modules or recordings are fitted one by one, and the gains are compared and averaged.
    Forward and reverse are compared, too, but not with --json or --paste.

    For example: sysid fit drive.wpilog --html drive.html
    """
    return work.run.fit_files(ctx, **options)
