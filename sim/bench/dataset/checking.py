"""Verify a finished dataset against its key and its spec."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from sim.bench.dataset.folder import compute_file_digest, list_unknown_logs
from sim.bench.dataset.key import index_by_file, read_key
from sim.bench.dataset.plan import LogJob
from sim.bench.dataset.secret import Secret
from sim.core.errors import BadRequest


def verify_dataset(
    folder: Path, jobs: Sequence[LogJob], *, key: Path, secret: Secret
) -> tuple[str, ...]:
    """The differences between a dataset and its key, a line each; empty if there are none.

    Args:
        folder: folder of the dataset.
        jobs: jobs of the current spec.
        key: path of the key.
        secret: secret with which the key is sealed.

    Raises:
        BadRequest: there is no key, its seal is broken, or a file cannot be read.
    """
    entries = read_key(key, secret=secret)
    if not entries:
        raise BadRequest(
            "there is no file with the key",
            where=str(key),
            advice="Run sysid dataset again until it has finished, or name the key with --key.",
        )
    files = index_by_file(entries)
    planned = {file: job.fingerprint for job in jobs for file in job.files}
    try:
        return (
            *_changed(folder, {file: entry["files"][file] for file, entry in files.items()}),
            *(f"in no key: {file}" for file in list_unknown_logs(folder, known=files)),
            *(f"not made yet: {file}" for file in planned if file not in files),
            *(
                f"of another spec: {file}"
                for file, entry in files.items()
                if planned.get(file) != entry["plan"]
            ),
        )
    except OSError as error:
        raise BadRequest(
            f"cannot be read ({error.strerror})", where=str(folder), advice="Allow reading it."
        ) from None


def _changed(folder: Path, hashes: dict[str, str]) -> Iterator[str]:
    """A line for each file that is missing or has another digest."""
    for file, made in hashes.items():
        found = compute_file_digest(folder / file)
        if found != made:
            yield f"{'changed' if found else 'missing'}: {file}"
