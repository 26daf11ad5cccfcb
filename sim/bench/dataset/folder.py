"""The folder of a dataset: make it, continue one that was interrupted, and verify it.

Files are written atomically, and foreign files are left alone.
"""

import hashlib
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.key import Entry, encode, read_key, write_key
from sim.bench.dataset.making import MadeLog
from sim.bench.dataset.plan import LogJob
from sim.core.errors import BadRequest
from sim.support.atomic_file import PARTS, atomic_path
from sim.support.os_errors import refuse_os_errors
from sim.support.printable import list_first
from sim.support.secret import Secret

MODIFIED = 946_684_800  # [s] 2000-01-01: real times would show how long each log took
WRITE = (
    "Make room there, or name a folder you may write to; then run the same command again: what is "
    "finished is kept."
)
SAVE, PART = (
    1.0,
    0.05,
)  # [s] between two writes of the key at least, and [share] of the time at most


@dataclass(frozen=True)
class DatasetPlace:
    """The folder of a dataset, and its key.

    Args:
        folder: folder of the log files.
        key: path of the key with the ground truth.
        dataset: name of the dataset.
        secret: secret with which the key is sealed.
        overwrite: whether files of other datasets may be replaced.
    """

    folder: Path
    key: Path
    dataset: str
    secret: Secret
    overwrite: bool = False

    def survey(self, jobs: Sequence[LogJob]) -> dict[str, Entry]:
        """Entries of the finished logs by the names of their jobs.

        Args:
            jobs: the planned jobs.

        Raises:
            BadRequest: there are files, or a key, of another dataset; or one cannot be read.
        """
        try:
            known = {entry["plan"]: entry for entry in read_key(self.key, secret=self.secret)}
        except BadRequest:
            if not self.overwrite:
                raise
            known = {}
        if self.folder.exists() and not self.folder.is_dir():
            raise BadRequest(
                "this is not a folder", where=str(self.folder), advice="Name another with -o."
            )
        kept = {}
        foreign: set[str] = set()
        for job in jobs:
            entry = known.pop(job.fingerprint, None)
            made = entry["files"] if entry else dict.fromkeys(job.files, "")
            digests = {file: self._compute_digest(file) for file in job.files}
            if entry and digests == made:
                kept[job.name] = entry
            foreign |= {
                file
                for file in job.files
                if digests[file] not in {"", made[file]} and made[file] is not None
            }
        stale = {file for entry in known.values() for file in entry["files"]}
        foreign |= {file for file in stale if (self.folder / file).exists()}
        if foreign and not self.overwrite:
            raise BadRequest(
                "these files are in the folder, but do not belong to this spec and secret: "
                f"{list_first(sorted(foreign))}",
                where=str(self.folder),
                advice="Name another folder with -o, move these files away, or add --overwrite: it "
                "replaces files, and drops those that the spec lacks from the answer key.",
            )
        return kept

    def make_logs(
        self,
        jobs: Sequence[LogJob],
        kept: Mapping[str, Entry],
        made: Iterable[MadeLog],
        say: Callable[[], None],
    ) -> None:
        """Write logs and the key.

        Args:
            jobs: the planned jobs.
            kept: entries of the logs that are finished already.
            made: the other logs, in any order.
            say: called after each log; an exception from it stops the run, with all files complete.

        Raises:
            BadRequest: a log cannot be made, or a file cannot be written.
        """
        entries = {
            job.name: encode(
                kept.get(job.name) or {"files": dict.fromkeys(job.files), "plan": job.fingerprint}
            )
            for job in jobs
        }
        with refuse_os_errors("cannot be written", self.folder, advice=WRITE):
            self.folder.mkdir(parents=True, exist_ok=True)
            for part in (*self.folder.rglob(PARTS), *self.key.parent.glob(PARTS)):
                part.unlink(missing_ok=True)  # a run that was killed left it
        self._write_key(entries)
        saved, took = time.monotonic(), 0.0
        try:
            for one in made:
                digests = {file: compute_digest(content) for file, content in one.contents.items()}
                for file, content in one.contents.items():
                    self.write_file(file, content)
                entries[one.job.name] = encode(
                    {"files": digests, **one.truth, "plan": one.job.fingerprint}
                )
                if time.monotonic() - saved > max(SAVE, took / PART):
                    begin = time.monotonic()
                    self._write_key(entries)
                    saved = time.monotonic()
                    took = saved - begin
                say()
        finally:
            self._write_key(entries)

    def write_file(self, file: str, content: bytes) -> None:
        """Write one file, unless it is there already.

        Raises:
            BadRequest: the disk is full, for example, or another program wrote such a file.
        """
        path = self.folder / file
        found = self._compute_digest(file)
        if found == compute_digest(content):
            return
        if found and not self.overwrite:
            raise BadRequest(
                "another program wrote or changed this file in the meantime",
                where=str(path),
                advice="Let it finish, move this file away, then run the same command again.",
            )
        with refuse_os_errors("cannot be written", path, advice=WRITE):
            path.parent.mkdir(parents=True, exist_ok=True)
            with atomic_path(path) as part:
                part.write_bytes(content)
                os.utime(part, (MODIFIED, MODIFIED))

    def verify(self, jobs: Sequence[LogJob]) -> Iterator[str]:
        """The differences between the dataset, its key and the jobs of a spec, a line each.

        Raises:
            BadRequest: there is no key, its seal is broken, or a file cannot be read.
        """
        entries = read_key(self.key, secret=self.secret)
        if not entries:
            raise BadRequest(
                "there is no file with the key",
                where=str(self.key),
                advice="Run sysid dataset again until it has finished, or name the key with --key.",
            )
        digests = {file: made for entry in entries for file, made in entry["files"].items()}
        plans = {file: entry["plan"] for entry in entries for file in entry["files"]}
        planned = {file: job.fingerprint for job in jobs for file in job.files}
        for file, made in digests.items():
            found = self._compute_digest(file)
            if made and found != made:
                yield f"{'changed' if found else 'missing'}: {file}"
        endings = {Path(file).suffix for file in digests}
        for path in sorted(self.folder.rglob("*")):
            file = path.relative_to(self.folder).as_posix()
            if path.suffix in endings and file not in digests:
                yield f"in no key: {file}"
        other = sum(plans[file] != planned.get(file) for file in plans)
        new = sum(not digests.get(file) for file in planned)
        if other:
            yield f"of another spec: {other} of {len(digests)} files"
        if new:
            yield f"not made yet: {new} of {len(planned)} files"

    def _write_key(self, entries: Mapping[str, str]) -> None:
        write_key(self.key, entries.values(), dataset=self.dataset, secret=self.secret)

    def _compute_digest(self, file: str) -> str:
        """SHA-256 of a file; empty if there is none.

        Raises:
            BadRequest: it exists, but cannot be read.
        """
        path = self.folder / file
        with refuse_os_errors("cannot be read", path, advice="Allow reading it."):
            return compute_digest(path.read_bytes()) if path.exists() else ""


def check_separation(folder: Path, **places: Path | None) -> None:
    """Refuse a folder of data that would also contain its key, spec or secret.

    Args:
        folder: folder of the data.
        places: path of the key, the spec and the secret.

    Raises:
        BadRequest: one of them is in the folder of the data.
    """
    for name, path in places.items():
        if path is not None and path.resolve().is_relative_to(folder.resolve()):
            raise BadRequest(
                f"the {name} lies in the folder of the data, so everybody who gets the "
                "data would get it, too",
                where=str(path),
                advice="Name another folder with -o"
                + (", or another place with --key." if name == "key" else "."),
            )


def compute_digest(content: bytes) -> str:
    """SHA-256 of a file's content."""
    return hashlib.sha256(content).hexdigest()
