"""The search for missing effects as one widget: choose an effect, fit it, look, decide."""

from collections.abc import Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from time import monotonic
from typing import Any

from sim.core.errors import BadRequest, Refusal
from sim.core.log import Log
from sim.core.units import Unit, convert_gains, find_unit
from sim.io import read
from sim.physics.effects import EFFECTS
from sim.physics.model import Model, Part
from sim.plot.gap_bars import plot_gap_bars
from sim.plot.picture import Picture
from sim.plot.table import Table
from sim.plot.voltage_residual import ResidualViews, make_residual_views, plot_voltage_residual
from sim.reconcile.by_hand import HandSearch, is_narrower
from sim.support.atomic_file import atomic_path

NONE = "gains alone"
SHOWN = {"log": "log", "validation": "validation"}  # logs whose gaps may be looked at, and names
MOST_BARS = 12  # models whose gaps are drawn
WORKING = "<p><b>Fitting… this takes one to three seconds.</b></p>"
PAGE = '<!doctype html><meta charset="utf-8"><title>The gap</title>'
LOOK = "Look at the plot with the largest share. Choose an effect that could cause it."


class EffectSearch:
    """Buttons and pictures with which a student finds the effects that a model lacks.

    Without buttons, plain code does the same: ``search.add("delay")``, ``search.take_back()`` and
    ``search.open()``.

    Args:
        log: runs to fit, the four tests at least.
        validation: other runs, which decide whether an effect helps.
        held_out: runs that are shown at the end; None shows none.
        truth: the hidden effects, if they are known; they are shown at the end.
    """

    def __init__(
        self,
        log: Log,
        *,
        validation: Log,
        held_out: Log | None = None,
        truth: Sequence[Part] = (),
    ) -> None:
        self.hand = HandSearch(log, validation=validation, held_out=held_out)
        self.truth = tuple(truth)
        self.effects: tuple[str, ...] = ()
        self.message = LOOK
        self.result = ""  # HTML, once the held-out log is open
        self._tried: dict[tuple[str, ...], dict[str, float]] = {}

    @classmethod
    def read(cls, folder: Path) -> "EffectSearch":
        """The search in the logs that an exercise wrote into a folder."""
        held_out = folder / "held-out.wpilog"
        return cls(
            read(folder / "log.wpilog"),
            validation=read(folder / "validation.wpilog"),
            held_out=read(held_out) if held_out.exists() else None,
        )

    # -- what a student does ---------------------------------------------------------------------

    def add(self, effect: str) -> str:
        """Add an effect and fit it; returns how the gap on the validation log changed.

        Raises:
            BadRequest: the effect is unknown or in the model, or the held-out log is open.
        """
        if effect in self.effects:
            raise BadRequest(f"{effect} is in the model already", advice="Add another effect.")
        return self.choose((*self.effects, effect))

    def take_back(self, effect: str = "") -> str:
        """Remove an effect, the last one by default; returns what became of the gap.

        Raises:
            BadRequest: it is not in the model, or the held-out log is open.
        """
        effect = effect or (self.effects or ("",))[-1]
        if effect not in self.effects:
            raise BadRequest("there is no such effect in the model", advice="Add an effect first.")
        return self.choose(tuple(one for one in self.effects if one != effect))

    def choose(self, effects: tuple[str, ...]) -> str:
        """Fit a model with these effects; returns what became of the gap on the validation log.

        Raises:
            BadRequest: an effect is unknown, or the held-out log is open.
        """
        if self.result:
            raise BadRequest(
                "the held-out log is open, so nothing may change any more",
                advice="Run the cell again to start from the beginning.",
            )
        before, begun = self.gaps["validation"], monotonic()
        after = self._measure_gap(effects)["validation"]
        self.effects = effects
        lower = "hardly better than" if after < before else "no better than"
        lower = "worse than" if is_narrower(before, after) else lower
        verdict = "better than" if is_narrower(after, before) else lower
        self.message = (
            f"With {' + '.join(effects) or NONE}, the gap of the validation log is {after:.3g} "
            f"times the noise. That is {verdict} before ({before:.3g}). Fitted in "
            f"{monotonic() - begun:.1f} s."
        )
        return self.message

    def open(self) -> str:
        """Open the held-out log: returns the lines of an answer, with both gaps of this log.

        The effect that narrows the gap most comes first.
        """
        alone = {one: self._measure_gap((one,))["validation"] for one in self.effects}
        self.effects = tuple(sorted(self.effects, key=lambda one: alone[one]))
        lines = self.answer
        if self.hand.recordings.held_out is not None:
            fits = (self.hand.fit(), self.hand.fit(self.effects))
            names = zip(("gap_before", "gap_after"), fits, strict=True)
            lines += [
                f"{name} = {self.hand.measure_gap(one, 'held_out'):.3g}" for name, one in names
            ]
        text = "\n".join(lines)
        truth = self.compare_with(self.truth, "the truth").html if self.truth else ""
        self.result = f"<p><b>The held-out log is open.</b></p><pre>{escape(text)}</pre>{truth}"
        return text

    # -- what a student sees ---------------------------------------------------------------------

    @property
    def model(self) -> Model:
        """The model with the chosen effects, in SI."""
        return [*self.steps.values()][-1]

    @property
    def steps(self) -> dict[str, Model]:
        """The models from gains alone to all chosen effects, by the effect that each added."""
        points = {NONE: self.hand.fit()}
        for count, name in enumerate(self.effects, start=1):
            points[f"+ {name}"] = self.hand.fit(self.effects[:count])
        return {name: point.structure.model(point.values) for name, point in points.items()}

    @property
    def gaps(self) -> dict[str, float]:
        """The gaps of the model on the log and on the validation log [times the noise]."""
        return self._measure_gap(self.effects)

    @property
    def views(self) -> ResidualViews:
        """Pictures of the voltage residual of the fitted runs and of the validation log."""
        return make_residual_views(self.hand.recordings.fitted_runs, self.model)

    @property
    def pictures(self) -> list[Picture]:
        """The gaps of the models tried so far, and what remains from five sides."""
        self._measure_gap(())
        tried = {" + ".join(one) or NONE: gaps for one, gaps in self._tried.items()}
        shown = dict(list(tried.items())[-MOST_BARS:])
        return [
            plot_gap_bars(shown),
            plot_voltage_residual(self.hand.recordings.fitted_runs, self.model),
        ]

    @property
    def html(self) -> str:
        """Everything that is shown, as HTML."""
        drawn = "".join(picture.html for picture in self.pictures)
        return f"<p><b>{escape(self.message)}</b></p>{self.result}{drawn}"

    def write_page(self, path: Path) -> None:
        """Write what is shown as a page for a browser."""
        with atomic_path(path) as part:
            part.write_text(f"{PAGE}{self.html}", encoding="utf-8")

    @property
    def answer(self) -> list[str]:
        """The effects and their parameters as lines of ``answers.toml``, in the log's unit."""
        listed = ", ".join(f'"{name}"' for name in self.effects)
        return [f"effects = [{listed}]"] + [
            f"{part.effect}.{name} = {one['value']:.5g}  # [{one['unit']}]"
            for part in self.model.parts
            for name, one in part.to_json(self._unit).items()
        ]

    @property
    def gains(self) -> dict[str, float]:
        """kS, kV and kA of the model, in the log's unit."""
        return convert_gains(self.model.gains, factor=self._unit.si)

    @cached_property
    def _unit(self) -> Unit:
        return find_unit(self.hand.recordings.log.units)

    def _measure_gap(self, effects: tuple[str, ...]) -> dict[str, float]:
        if effects not in self._tried:
            point = self.hand.fit(effects)
            self._tried[effects] = {
                shown: self.hand.measure_gap(point, name) for name, shown in SHOWN.items()
            }
        return self._tried[effects]

    def compare_with(self, parts: Sequence[Part], name: str) -> Table:
        """The parameters of the chosen effects next to those of another model.

        Args:
            parts: the effects of the other model.
            name: what it is called.
        """
        found, other = (
            {
                f"{part.effect}.{name} [{one['unit']}]": one["value"]
                for part in some
                for name, one in part.to_json(self._unit).items()
            }
            for some in (self.model.parts, parts)
        )
        rows = [(key, found.get(key, "none"), other.get(key, "none")) for key in {**other, **found}]
        return Table(("effect", "yours", name), tuple(rows) or (("none", "none", "none"),))

    # -- buttons ---------------------------------------------------------------------------------

    @cached_property
    def _make_box(self) -> Any:  # noqa: ANN401 - ipywidgets has no types
        import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

        wide = {"width": "max-content"}
        menu = ipywidgets.Dropdown(options=sorted(EFFECTS), description="effect", value=None)
        about, shown = ipywidgets.HTML(), ipywidgets.HTML()
        buttons = {
            "Add and fit": lambda: self.add(menu.value) if menu.value else "Choose an effect.",
            # the effect that the menu shows, or else the last one
            "Take back": lambda: self.take_back(menu.value if menu.value in self.effects else ""),
            "Stop, open the held-out log": self.open,
        }
        pressed = [ipywidgets.Button(description=name, layout=wide) for name in buttons]

        def explain(_: object) -> None:
            effect = EFFECTS[menu.value]
            about.value = f"<p>{escape(effect.summary)}. {escape(effect.fingerprint)}</p>"

        def press(button: Any) -> None:  # noqa: ANN401 - ipywidgets has no types
            about.value = WORKING
            for one in pressed:
                one.disabled = True
            try:
                buttons[button.description]()
                about.value, shown.value = "", self.html
            except Refusal as refusal:
                about.value = f"<p><b>{escape(str(refusal))}</b></p>"
            for one in pressed:
                one.disabled = bool(self.result)

        for one in pressed:
            one.on_click(press)
        menu.observe(explain, "value")
        shown.value = self.html
        return ipywidgets.VBox([ipywidgets.HBox([menu, *pressed]), about, shown])

    def __repr__(self) -> str:
        return f"EffectSearch({' + '.join(self.effects) or NONE})"

    def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
        still = {"text/plain": repr(self), "text/html": self.html}  # where no buttons can be shown
        return self._make_box._repr_mimebundle_(**how) | still
