"""Make a dataset, or continue one that was interrupted."""

import hashlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.folder import DatasetFolder, FolderSurvey, survey_folder
from sim.bench.dataset.key import Entry, Journal, read_key, write_key
from sim.bench.dataset.making import FailedLog, MadeLog, make_log
from sim.bench.dataset.plan import LogJob
from sim.bench.dataset.secret import Secret
from sim.core.errors import BadRequest
from sim.support.printable import list_first

LISTED = 3  # [files] that a refusal names
Maker = Callable[[Sequence[LogJob]], Iterator[MadeLog | FailedLog]]


@dataclass(frozen=True)
class DatasetPlace:
    """The folder of a dataset, and the file of its key.

    Args:
        folder: for the files.
        key: for the truth.
    """

    folder: Path
    key: Path

    def check_separation(self, *, spec: Path, secret: Path | None) -> None:
        """Refuse a folder of data that would also contain its key, spec or secret.

        Args:
            spec: the file that says what is done to the logs.
            secret: the file that all is drawn from.

        Raises:
            BadRequest: the key, the spec or the secret lies in the folder of the data.
        """
        folder = self.folder.resolve()
        for name, path in (("key", self.key), ("spec", spec), ("secret", secret)):
            if path is not None and path.resolve().is_relative_to(folder):
                raise BadRequest(
                    f"the {name} lies in the folder of the data, so whoever gets the data "
                    "would get it too",
                    where=str(path),
                    advice="Name another folder with -o"
                    + (", or another place with --key." if name == "key" else "."),
                )


def check_folder(
    place: DatasetPlace, jobs: Sequence[LogJob], *, secret: Secret, overwrite: bool
) -> FolderSurvey:
    """Survey the folder of a dataset; refuse if it holds anything else.

    Args:
        place: where the dataset goes.
        jobs: the plan.
        secret: what the key is sealed with.
        overwrite: replace what is not this dataset's.

    Raises:
        BadRequest: files, or a key, of something else are there.
    """
    try:
        with _needing(place.key):
            known = [
                *read_key(place.key, secret=secret),
                *Journal(place.key, secret=secret).read(),
            ]
    except BadRequest:
        if not overwrite:
            raise
        known = []
    found = survey_folder(place.folder, jobs, known=known)
    if found.foreign and not overwrite:
        raise BadRequest(
            f"these files are in the folder, but do not belong to this spec and secret: "
            f"{list_first(found.foreign, most=LISTED)}",
            where=str(place.folder),
            advice="Name another folder with -o, or replace these files with --overwrite.",
        )
    if found.stale and not overwrite:
        files = [file for entry in found.stale for file in entry["files"]]
        raise BadRequest(
            f"these files belonged to this dataset, but the spec no longer contains them: "
            f"{list_first(files, most=LISTED)}",
            where=str(place.folder),
            advice="Move these files away, name another folder with -o, or add --overwrite. "
            "Then the key no longer contains these files.",
        )
    return found


def rehearse_jobs(jobs: Sequence[LogJob]) -> None:
    """Make one log of each kind with all its effects and faults, to find impossible specs early.

    Raises:
        BadRequest: one of them cannot be made.
    """
    fullest: dict[tuple[str, str], LogJob] = {}
    for job in jobs:
        kind = (job.where, job.mechanism)
        if kind not in fullest or _parts(job) > _parts(fullest[kind]):
            fullest[kind] = job
    for job in fullest.values():
        _sound(make_log(job))


def finish_dataset(
    place: DatasetPlace,
    found: FolderSurvey,
    *,
    maker: Maker,
    dataset: str,
    secret: Secret,
    overwrite: bool,
    say: Callable[[], None],
) -> None:
    """Make the logs that are missing, and write the key.

    Args:
        place: where the dataset goes.
        found: what is there.
        maker: makes jobs.
        dataset: its name.
        secret: what the key is sealed with.
        overwrite: replace what is not this dataset's.
        say: called after each log; what it raises stops the run, with all files whole.

    Raises:
        BadRequest: a log cannot be made, or a file not be written.
    """
    journal = Journal(place.key, secret=secret)
    left = len(found.todo)
    shelf = DatasetFolder(
        place.folder, mine=None if overwrite else _files(found.todo, place.folder)
    )
    try:
        shelf.create()
        with _needing(place.key):
            journal.start(found.kept)
        for result in maker(found.todo):
            made = _sound(result)
            entry = _entry(made)
            with _needing(place.key):
                journal.add(entry)
            shelf.write_files(made.contents)
            left -= 1
            say()
        if left:
            raise RuntimeError(f"{len(found.todo)} logs to make, and {left} did not come back")
        with _needing(place.key):
            count = write_key(place.key, journal, dataset=dataset, secret=secret)
        if count != len(found.kept) + len(found.todo):
            raise RuntimeError(f"{count} logs in the key, and that is not all")
    finally:
        journal.close()
        shelf.remove_empty_folders()
    journal.remove()


def _sound(result: MadeLog | FailedLog) -> MadeLog:
    """What was made, or a refusal with the place in the spec."""
    if isinstance(result, FailedLog):
        raise BadRequest(
            result.what, where=f"{result.job.where} ({result.job.name})", advice=result.advice
        )
    return result


def _entry(made: MadeLog) -> Entry:
    """What the key says of a log."""
    hashes = {file: hashlib.sha256(content).hexdigest() for file, content in made.contents.items()}
    return {"files": hashes, **made.truth, "plan": made.job.fingerprint}


def _files(jobs: Sequence[LogJob], folder: Path) -> list[str]:
    """Files of unfinished logs that are there: half of a log that was being finished."""
    return [file for job in jobs for file in job.files if (folder / file).exists()]


def _parts(job: LogJob) -> int:
    return len(job.effects) + len(job.strikes)


@contextmanager
def _needing(key: Path) -> Iterator[None]:
    """Refuse in one line if the key, or the journal beside it, cannot be had."""
    try:
        yield
    except OSError as error:
        raise BadRequest(
            f"the key cannot be written ({error.strerror or error})",
            where=str(key),
            advice="Make room there, or name another place with --key; then run the same command "
            "again: what is finished is kept.",
        ) from None
