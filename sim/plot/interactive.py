"""Interactive pictures, which are drawn again whenever a widget changes."""

from collections.abc import Callable, Sequence
from typing import Any

from sim.core.errors import Refusal
from sim.plot.picture import Picture


def show_interactive(draw: Callable[..., Picture | Sequence[Picture]], **knobs: Any) -> Any:  # noqa: ANN401 - ipywidgets has no types
    """Show a picture below widgets that set the arguments of the function that draws it.

    The picture is plain HTML, so the page needs no drawing library. It is the same picture that
    the function returns without widgets: ``draw(ramp=1.0)``. A page that cannot show widgets shows
    the picture alone.

    Args:
        draw: function of keyword arguments that returns one picture, or several.
        knobs: argument -> widget whose ``value`` is passed.

    Returns:
        A widget, to be the last expression of a notebook cell.
    """
    import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

    shown = ipywidgets.HTML()

    class InteractivePicture(ipywidgets.VBox):  # type: ignore[misc]  # no types
        def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
            return super()._repr_mimebundle_(**how) | {"text/html": shown.value}

    last: list[Picture] = []

    def redraw(_: object = None) -> None:
        try:
            drawn = draw(**{name: knob.value for name, knob in knobs.items()})
        except Refusal as refusal:  # show the reason in place of the picture
            shown.value = f"<p>{refusal}</p>"
            return
        pictures = [drawn] if isinstance(drawn, Picture) else drawn
        for picture, before in zip(pictures, last, strict=False):
            picture.place_as(before)
        shown.value = "".join(picture.html for picture in pictures)
        last[:] = pictures

    for knob in knobs.values():
        knob.observe(redraw, "value")
    redraw()
    return InteractivePicture([*knobs.values(), shown])
