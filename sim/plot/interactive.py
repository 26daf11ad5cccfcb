"""A picture with knobs: it is drawn again whenever one of them is turned."""

from collections.abc import Callable, Sequence
from typing import Any

from sim.core.errors import Refusal
from sim.plot.picture import Picture


def show_interactive(draw: Callable[..., Picture | Sequence[Picture]], **knobs: Any) -> Any:  # noqa: ANN401 - ipywidgets has no types
    """Show a picture below widgets that set the arguments it is drawn with.

    The picture is plain HTML in the page, so it needs no drawing library there; and what is drawn
    is what the same call gives without any widget: ``draw(ramp=1.0)``.

    Args:
        draw: arguments by name -> one picture, or several to stand below each other.
        knobs: argument -> widget whose ``value`` is passed.

    Returns:
        A widget to end a notebook cell with.
    """
    import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

    shown = ipywidgets.HTML()

    def redraw(_: object = None) -> None:
        try:
            drawn = draw(**{name: knob.value for name, knob in knobs.items()})
        except Refusal as refusal:  # a knob may ask for what cannot be done: say so in its place
            shown.value = f"<p>{refusal}</p>"
            return
        pictures = [drawn] if isinstance(drawn, Picture) else drawn
        shown.value = "".join(picture.html for picture in pictures)

    for knob in knobs.values():
        knob.observe(redraw, "value")
    redraw()
    return ipywidgets.VBox([*knobs.values(), shown])
