"""What the page shows of every log, and how marked time spans are written."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class SpanText:
    """The text format of marked time spans, for pasting into an answer.

    Texts in braces are replaced: ``{log}`` the file without its suffix, ``{test}``, ``{key}`` the
    test with ``_`` for ``-``, ``{begin}`` and ``{end}`` in seconds since the test began.

    Args:
        before: text before the first span.
        span: text of one span.
        between: text between two spans.
        after: text after the last span.
        hint: tells the user what to do with the text.
    """

    before: str = ""
    span: str = "{test}, {begin} to {end} s after its start"
    between: str = "\n"
    after: str = ""
    hint: str = ""


@dataclass(frozen=True)
class PageView:
    """What the page shows of every log.

    Args:
        raw: show the data alone, without faults and fit.
        span_text: how marked spans are written.
    """

    raw: bool = False
    span_text: SpanText = field(default_factory=SpanText)
