"""What the page shows of every log, and how spans that a person marks are written."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class SpanText:
    """The text format of marked time spans, for pasting into an answer.

    Texts in braces are replaced: ``{log}`` the file without its suffix, ``{test}``, ``{key}`` the
    test with ``_`` for ``-``, ``{begin}`` and ``{end}`` in seconds since the test began.

    Args:
        before: what comes first.
        span: a span; those of several tests come one after another.
        between: what stands between two of them.
        after: what comes last.
        hint: what to do with it, for the person.
    """

    before: str = ""
    span: str = "{test}, {begin} to {end}"
    between: str = "\n"
    after: str = ""
    hint: str = ""


@dataclass(frozen=True)
class PageView:
    """Options of what the page shows of every log.

    Args:
        raw: the data alone: nothing is detected or fitted.
        span_text: how marked spans are written.
    """

    raw: bool = False
    span_text: SpanText = field(default_factory=SpanText)
