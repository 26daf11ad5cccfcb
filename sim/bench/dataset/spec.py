"""The spec of a dataset: an instructor's TOML file, read and checked as a whole.

``example.toml`` in this folder explains every key.
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.logs import LOGS, MOST_LOGS, LogSettings, LogTable, read_logs, read_settings
from sim.bench.dataset.roster import read_students
from sim.bench.dataset.table import TomlTable
from sim.core.errors import BadRequest

FORMATS = ("wpilog", "csv")
ENDING = ".secret"  # suffix of a file with a secret
LARGEST_SEED = 2**63 - 1  # TOML's largest whole number
TOP = ("name", "seed", "secret", "students", "formats", "routine", "logs")


@dataclass(frozen=True)
class Spec:
    """The specification of a dataset.

    Args:
        where: path of the file, as given.
        name: name of the dataset; another name gives other data.
        seed: seed of all random choices, if nothing is secret.
        secret: file with the secret from which all seeds are derived.
        students: names of the students, each with logs of their own; may be empty.
        formats: formats in which each log is written.
        logs: tables of logs.
    """

    where: str
    name: str
    seed: int | None
    secret: Path | None
    students: tuple[str, ...]
    formats: tuple[str, ...]
    logs: tuple[LogTable, ...]


def read_spec(path: Path) -> Spec:
    """Read a spec and check it, as far as possible without making a log.

    Raises:
        BadRequest: it cannot be read, or a value is wrong; the message names the key.
    """
    top = TomlTable(_parse_toml(path), where=str(path), known=TOP)
    name = top.read_text("name", example="week3")
    if len(name) > 64 or not name.isprintable():  # noqa: PLR2004 - the limit of a student's name
        top.refuse_value("name", advice="Give a name of 1 to 64 characters.")
    settings = read_settings(top, default=LogSettings())
    logs = tuple(
        read_logs(one, default=settings) for one in top.read_tables("logs", name="logs", known=LOGS)
    )
    if not logs:
        top.refuse("there is no [[logs]] in it", advice="Add one, with mechanisms and count.")
    spec = Spec(
        where=str(path),
        name=name,
        seed=top.read_integer("seed", least=0, most=LARGEST_SEED) if "seed" in top else None,
        secret=_secret(top, folder=path.parent),
        students=read_students(top, folder=path.parent),
        formats=top.read_choices("formats", FORMATS) if "formats" in top else FORMATS[:1],
        logs=logs,
    )
    total = max(len(spec.students), 1) * sum(one.count * len(one.mechanisms) for one in logs)
    if total > MOST_LOGS:
        top.refuse(
            f"{total} logs are requested",
            advice=f"Make several datasets: each dataset can have at most {MOST_LOGS} logs.",
        )
    return spec


def _parse_toml(path: Path) -> object:
    """The content of a TOML file."""
    try:
        return tomllib.loads(path.read_bytes().decode("utf-8-sig"))
    except FileNotFoundError:
        raise BadRequest(
            "there is no such file",
            where=str(path),
            advice=f"Write an example there with: sysid dataset --example {path}",
        ) from None
    except OSError as error:
        raise BadRequest(
            f"cannot be read ({error.strerror})", where=str(path), advice="Give a TOML file."
        ) from None
    except UnicodeDecodeError:
        raise BadRequest("is not UTF-8", where=str(path), advice="Save it as UTF-8.") from None
    except tomllib.TOMLDecodeError as error:
        raise BadRequest(
            f"is not TOML: {error}", where=str(path), advice="Mend that line."
        ) from None


def _secret(top: TomlTable, *, folder: Path) -> Path | None:
    """The file with the secret. Messages do not repeat its name, which might be the secret."""
    if "secret" not in top:
        return None
    if "seed" in top:
        top.refuse("the spec has both a seed and a secret", advice="Leave one of them out.")
    name = top.read_text("secret", example=f"class{ENDING}")
    if not name.endswith(ENDING) or len(name) == len(ENDING):
        top.refuse(
            f"secret is not the name of a file that ends in {ENDING}",
            advice=f'Write secret = "class{ENDING}" into the spec, and run this command again: it '
            "makes the file. Others may read the spec, so the secret itself must not be in it.",
        )
    return folder / name
