"""A search for missing effects that runs in the background: its progress and its story."""

import math
import threading
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from sim.core.errors import BadRequest, Refusal
from sim.core.leave_out import LeftOutPart
from sim.core.log import Log
from sim.inspect.detect_faults import inspect
from sim.inspect.dropout_intervals import find_dropout_intervals
from sim.reconcile import DamagedInterval, Story, reconcile
from sim.reconcile.damage import LEFT_OUT
from sim.reconcile.model_variant import ModelVariant
from sim.reconcile.story_text import (
    explain_unapplied_effects,
    format_gap,
    format_parameter,
    list_gain_doubts,
    list_inspections,
    list_next_tests,
    list_outcomes,
    list_remarks,
    write_headline,
)
from sim.support.printable import finite_or_none

DROPOUT = "voltage-dropout"  # an inspection reports many short dropouts as one interval
PLACES = 5  # places listed where the base model's residual is largest


class ReconcileJob:
    """One search, in a thread of its own.

    Args:
        read: reads the logs: ``log``, and ``validation`` and ``held_out`` if they are given.
        name: name of its file, as the page shows it.
        type: type of the mechanism; None takes the one in the file.
        effort: [1] as of ``reconcile``.
        left_out: parts of the log that are not used.
    """

    def __init__(
        self,
        read: Callable[[], Mapping[str, Log]],
        *,
        name: str,
        type: str | None,  # noqa: A002 - the field's own word
        effort: float,
        left_out: Sequence[LeftOutPart] = (),
    ) -> None:
        self._read, self._name, self._type, self._effort = read, name, type, effort
        self._left_out = left_out
        self._words, self._share = "looking for damage", 0.0
        self._said: set[str] = set()  # warnings about the logs, which the page shows anyhow
        self._stopped = threading.Event()
        self._refusal: Refusal | None = None
        self.story: Story | None = None
        threading.Thread(target=self._run, daemon=True).start()

    def to_json(self) -> dict[str, Any]:
        """Progress of the search, and its result once it has ended, as plain data.

        Raises:
            Refusal: the log cannot be reconciled.
        """
        if self._refusal is not None:
            raise self._refusal
        story = None if self.story is None else describe_story(self.story, self._said)
        if story is not None and self._stopped.is_set() and not story["complete"]:
            story["headline"] = f"You stopped the search. {story['headline']}"
        return {"words": self._words, "share": self._share, "story": story}

    def stop(self) -> None:
        """Let the search end soon, with the best model so far."""
        self._stopped.set()

    def refit(self, effects: Collection[str]) -> ModelVariant:
        """The model of the story with some of its effects.

        Raises:
            BadRequest: the search has not ended.
        """
        if self.story is None:
            raise BadRequest("the search has not ended", advice="Wait for it, or stop it.")
        return refit_story(self.story, effects)

    def _run(self) -> None:
        """Run the search; an error is reported when the page asks for its progress."""
        try:
            logs = self._read()
            self._said = {doubt.text for log in logs.values() for doubt in log.doubts}
            self.story = search_effects(
                logs, type=self._type, effort=self._effort, progress=self._store_progress,
                is_stopped=self._stopped.is_set, left_out=self._left_out,
            )  # fmt: skip
        except Refusal as refusal:
            self._refusal = refusal
        except Exception as error:  # noqa: BLE001 - a bug must not leave the page waiting
            self._refusal = Refusal(
                f"our mistake, not yours ({type(error).__name__}: {error})",
                where=self._name,
                advice="Try sysid reconcile, which says more.",
            )

    def _store_progress(self, words: str, share: float) -> None:
        self._words, self._share = words, share


def refit_story(story: Story, effects: Collection[str]) -> ModelVariant:
    """The model of a story with some of its effects, and with the doubts about its gains.

    Raises:
        BadRequest: the story has no model with effects.
    """
    if story.variants is None:
        raise BadRequest("no effect was found", advice="Use the gains of the fit.")
    variant = story.variants.refit(effects)
    return replace(variant, doubts=list_gain_doubts(story), narrows=story.narrows(variant.gap))


def describe_story(story: Story, said: Collection[str] = ()) -> dict[str, Any]:
    """A story as plain data: sentences, and gaps in times the noise of the velocity.

    Args:
        story: the result of reconcile.
        said: remarks to leave out.
    """
    remarks = list_remarks(story) if story.complete else story.notes
    added = [one.added for one in story.chapters[1:]]
    names = ["base model", *(f"+ {one}" for one in added)]
    findings = [
        {
            "name": " or ".join([one.effect, *one.ambiguous_with]),
            "kind": one.kind,
            "size": one.size,
            "sentence": one.sentence,
            "parameters": [format_parameter(*pair) for pair in one.parameters.items()],
            "look": [list(pair) for pair in list_inspections(one)],
        }
        for one in story.findings
    ]
    gaps = [
        {
            "name": name,
            "text": format_gap(chapter.gap, story),
            "gap": finite_or_none(chapter.gap / (story.noise_floor or math.nan)),
        }
        for name, chapter in zip(names, story.chapters, strict=True)
    ]
    return {
        "headline": write_headline(story),
        "verdict": story.verdict,
        "complete": story.complete,
        "effects": added if story.variants else [],
        "tried": [f"{', '.join(some)}: {what}" for what, some in list_outcomes(story).items()],
        "findings": findings,
        "gaps": gaps,
        "places": [place.sentence for place in story.where[:PLACES]],
        "next": list(list_next_tests(story)),
        "caution": " ".join(one.text for one in list_gain_doubts(story)),
        "why_unticked": explain_unapplied_effects(story),
        "remarks": [one for one in remarks if one not in said],
        "how": story.how,
    }


def search_effects(
    logs: Mapping[str, Log],
    *,
    type: str | None,  # noqa: A002 - the field's own word
    effort: float,
    progress: Callable[[str, float], None],
    left_out: Sequence[LeftOutPart] = (),
    **more: Any,  # noqa: ANN401 - passed on
) -> Story:
    """The story of these logs, without damage and without the parts that the user left out.

    Args:
        logs: ``log``, and ``validation`` and ``held_out`` if they are given.
        type: type of the mechanism; None takes the one in the file.
        effort: [1] as of ``reconcile``.
        progress: called with words and with the share that is done.
        left_out: parts of the log that are not used.
        more: further arguments of ``reconcile``.

    Raises:
        Refusal: the log cannot be reconciled.
    """
    progress("looking for damage", 0.0)
    log, *_ = logs.values()
    damages = {name: inspect_damage(some) for name, some in logs.items() if name != "log"}
    gone = [
        DamagedInterval(k, float(time[0]), float(time[-1]), LEFT_OUT, 1.0, "", "")
        for part in left_out
        for k, run in enumerate(log.runs)
        if (time := run.time[part.find(run)]).size
    ]
    rest = inspect_damage(log, left_out=left_out)
    return reconcile(
        log,
        validation=logs.get("validation"),
        held_out=logs.get("held_out"),
        type=type or log.type or "simple",
        effort=effort,
        progress=progress,
        damages=damages | {"log": (*rest, *gone)},
        **more,
    )


def inspect_damage(
    log: Log, *, left_out: Sequence[LeftOutPart] = ()
) -> tuple[DamagedInterval, ...]:
    """The damaged intervals that an inspection finds in a log, as ``reconcile`` takes them.

    What is ordinary, such as frames of 20 ms, is no damage.

    Args:
        log: the log.
        left_out: parts whose damage does not count.
    """
    found = []
    for one in inspect(log).damages:
        where = one.where
        if one.ordinary or any(
            part.covers(where.test, where.start, where.end) for part in left_out
        ):
            continue
        intervals: tuple[tuple[float, float], ...] = ((where.start, where.end),)
        if one.fault == DROPOUT and where.run is not None:
            intervals = find_dropout_intervals(
                log.runs[where.run], start=where.start, end=where.end
            )
        found += [
            DamagedInterval(
                where.run, *interval, one.fault, one.confidence, one.evidence, str(one.advice)
            )
            for interval in intervals
        ]
    return tuple(found)
