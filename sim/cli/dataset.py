"""``sysid dataset``."""

from contextlib import closing
from importlib.resources import files
from pathlib import Path

import click

from sim.bench.dataset.folder import DatasetPlace, check_separation
from sim.bench.dataset.key import choose_key_path
from sim.bench.dataset.making import make_log, rehearse_logs
from sim.bench.dataset.plan import LogJob, plan_jobs
from sim.bench.dataset.spec import read_spec
from sim.cli.options import FILE
from sim.support.command_line import DONE, INTERRUPTED, NOT_RIGHT, print_error, quote_path
from sim.support.os_errors import refuse_os_errors
from sim.support.work.executor import count_available_cores, run_jobs
from sim.support.work.interrupt import deferred_interrupt
from sim.support.work.progress_bar import progress_bar

WORTH = 50  # [logs] per process at least: for fewer, starting it takes longer than it saves


@click.command()
@click.argument("spec", type=FILE)
@click.option("-o", "--output", type=FILE, help="Folder for the logs.")
@click.option("--key", type=FILE, help="File for the truth.  [default: FOLDER.key.json]")
@click.option(
    "--processes",
    type=click.IntRange(min=1),
    help="Number of processes that make logs.  [default: every core]",
)
@click.option("--cluster", metavar="ADDRESS", help="Dask cluster that makes logs: tcp://host:8786.")
@click.option("--overwrite", is_flag=True, help="Replace files that do not belong to this dataset.")
@click.option(
    "--check",
    is_flag=True,
    help="Make no logs; report which logs have changed or are missing.",
)
@click.option("--example", is_flag=True, help="Write an example of a SPEC, with every key.")
def dataset(  # noqa: PLR0917 - click passes options by name
    spec: Path,
    output: Path | None,
    key: Path | None,
    processes: int | None,
    cluster: str | None,
    overwrite: bool,  # noqa: FBT001 - click passes it by name
    check: bool,  # noqa: FBT001 - the same
    example: bool,  # noqa: FBT001 - the same
) -> int:
    """Make many damaged logs, as the file SPEC describes them.

    The command also makes a sealed key with the true values. The key is next to the folder, never
    in it. If the command was stopped, run it again to continue.

    For example: sysid dataset week3.toml -o week3
    """
    if example:
        return _write_example(spec)
    if output is None:
        raise click.UsageError("Missing option '-o': a folder for the logs.")

    asked = read_spec(spec)
    key = key or choose_key_path(output)
    check_separation(output, key=key, spec=spec, secret=asked.secret)
    secret = asked.find_secret(make=not check)
    place = DatasetPlace(output, key, asked.name, secret, overwrite)
    jobs = plan_jobs(asked, secret)
    if check:
        return _check_logs(place, jobs)
    return _make_missing_logs(place, jobs, processes=processes, cluster=cluster)


def _make_missing_logs(
    place: DatasetPlace,
    jobs: tuple[LogJob, ...],
    *,
    processes: int | None,
    cluster: str | None,
) -> int:
    """Make the logs that are missing, with a progress bar; the exit code."""
    kept = place.survey(jobs)
    todo = [job for job in jobs if job.name not in kept]
    rehearse_logs(todo)
    secret = place.secret
    if secret.new:
        secret.save()
        click.echo(f"{secret.new}: a new secret. Keep this file, and show it to nobody.", err=True)
    made = run_jobs(
        make_log, todo, processes=processes or count_available_cores(), worth=WORTH, cluster=cluster
    )
    with (
        progress_bar("logs", len(jobs), done=len(kept)) as (step, done),
        deferred_interrupt() as stop_if_noted,
        closing(made),
    ):

        def say() -> None:
            step()
            stop_if_noted()

        try:
            place.make_logs(jobs, kept, made, say)
        except KeyboardInterrupt:
            stopped = True
        else:
            stopped = False
    if stopped:
        text = f"stopped with {done()} of {len(jobs)} logs done. Run the same command to continue."
        print_error(text, name="sysid")
        return INTERRUPTED
    earlier = f", {len(kept)} of them made earlier" if kept else ""
    click.echo(f"{place.folder}: {len(jobs)} logs{earlier}. The truth about them: {place.key}")
    return DONE


def _check_logs(place: DatasetPlace, jobs: tuple[LogJob, ...]) -> int:
    """Print which logs have changed or are missing; the exit code."""
    wrong = list(place.verify(jobs))
    for line in wrong:
        click.echo(line)
    if not wrong:
        click.echo(f"{place.folder}: {len(jobs)} logs, all unchanged; the seal is intact.")
    return NOT_RIGHT if wrong else DONE


def _write_example(path: Path) -> int:
    """Write the example of a spec into a new file; the exit code.

    Raises:
        BadRequest: the file exists, or cannot be written.
    """
    text = files("sim.bench.dataset").joinpath("example.toml").read_text(encoding="utf-8")
    advice = "Name a new file, in a folder you may write to."
    with (
        refuse_os_errors("the example cannot be written", path, advice=advice),
        path.open("x", encoding="utf-8", newline="\n") as stream,
    ):
        stream.write(text)
    following = f"sysid dataset {quote_path(path)} -o {quote_path(path.stem)}"
    click.echo(f"{path}: an example. Edit it, then: {following}")
    return DONE
