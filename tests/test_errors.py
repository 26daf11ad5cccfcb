"""A refusal says what, where and what next, and can travel to another process."""

import pickle

import pytest

from sim.core.errors import BadRequest, BadSample, MissingSignal, NotIdentifiable, UnreadableFile


@pytest.mark.parametrize(
    "kind", [BadRequest, BadSample, MissingSignal, NotIdentifiable, UnreadableFile]
)
def test_refusal_is_unchanged_by_pickling(kind):
    sent = kind("velocity is nan", where="log.csv, line 17", advice="Remove that sample.")

    got = pickle.loads(pickle.dumps(sent))  # noqa: S301 - our own, a line ago

    assert type(got) is kind
    assert str(got) == "log.csv, line 17: velocity is nan. Remove that sample."
