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

LISTED = 3  # files in a message, at most
Maker = Callable[[Sequence[LogJob]], Iterator[MadeLog | FailedLog]]


@dataclass(frozen=True)
class DatasetPlace:
    """The folder of a dataset, and the file of its key.

    Args:
        folder: folder of the log files.
        key: path of the key with the ground truth.
    """

    folder: Path
    key: Path

    def check_separation(self, *, spec: Path, secret: Path | None) -> None:
        """Refuse a folder of data that would also contain its key, spec or secret.

        Args:
            spec: path of the spec.
            secret: path of the secret, if there is one.

        Raises:
            BadRequest: the key, the spec or the secret is in the folder of the data.
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
    """Survey the folder of a dataset; refuse files that would be replaced.

    Args:
        place: folder and key of the dataset.
        jobs: the planned jobs.
        secret: secret with which the key is sealed.
        overwrite: whether files of other datasets may be replaced.

    Raises:
        BadRequest: there are files, or a key, of another dataset.
    """
    try:
        with _refuse_key_errors(place.key):
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
        if kind not in fullest or _count_parts(job) > _count_parts(fullest[kind]):
            fullest[kind] = job
    for job in fullest.values():
        _require_made(make_log(job))


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
        place: folder and key of the dataset.
        found: survey of the folder.
        maker: makes the logs of jobs, in any order.
        dataset: name of the dataset.
        secret: secret with which the key is sealed.
        overwrite: whether files of other datasets may be replaced.
        say: called after each log; an exception from it stops the run, with all files complete.

    Raises:
        BadRequest: a log cannot be made, or a file cannot be written.
    """
    journal = Journal(place.key, secret=secret)
    left = len(found.todo)
    target = DatasetFolder(
        place.folder, mine=None if overwrite else _files(found.todo, place.folder)
    )
    try:
        target.create()
        with _refuse_key_errors(place.key):
            journal.start(found.kept)
        for result in maker(found.todo):
            made = _require_made(result)
            entry = _entry(made)
            with _refuse_key_errors(place.key):
                journal.add(entry)
            target.write_files(made.contents)
            left -= 1
            say()
        if left:
            raise RuntimeError(f"{len(found.todo)} logs to make, and {left} did not come back")
        with _refuse_key_errors(place.key):
            count = write_key(place.key, journal, dataset=dataset, secret=secret)
        if count != len(found.kept) + len(found.todo):
            raise RuntimeError(f"{count} logs in the key, and that is not all")
    finally:
        journal.close()
        target.remove_empty_folders()
    journal.remove()


def _require_made(result: MadeLog | FailedLog) -> MadeLog:
    """The log, if it was made.

    Raises:
        BadRequest: it was not; the message has the place in the spec.
    """
    if isinstance(result, FailedLog):
        raise BadRequest(
            result.what, where=f"{result.job.where} ({result.job.name})", advice=result.advice
        )
    return result


def _entry(made: MadeLog) -> Entry:
    """The key's entry of a log."""
    hashes = {file: hashlib.sha256(content).hexdigest() for file, content in made.contents.items()}
    return {"files": hashes, **made.truth, "plan": made.job.fingerprint}


def _files(jobs: Sequence[LogJob], folder: Path) -> list[str]:
    """Existing files of unfinished logs, from an interrupted run."""
    return [file for job in jobs for file in job.files if (folder / file).exists()]


def _count_parts(job: LogJob) -> int:
    """Number of hidden effects and faults of a log."""
    return len(job.effects) + len(job.strikes)


@contextmanager
def _refuse_key_errors(key: Path) -> Iterator[None]:
    """Turn an OSError about the key or its journal into a BadRequest."""
    try:
        yield
    except OSError as error:
        raise BadRequest(
            f"the key cannot be written ({error.strerror or error})",
            where=str(key),
            advice="Make room there, or name another place with --key; then run the same command "
            "again: what is finished is kept.",
        ) from None
