"""A step response in a few numbers and in plain words."""

from dataclasses import dataclass
from itertools import pairwise

from sim.feedback.response import StepResponse

NEARLY = 0.9  # [of the step] where the target counts as reached
BAND = 0.05  # [of the step] around the target, in which it counts as settled
RINGS = 0.25  # [of the step] past the target, from which a loop is too lively to hand over
LAST = 0.3  # [of the time watched] in which a loop that settles has settled
STILL = 0.01  # [of the step] moved in that time: it stands
AWAY = 1.0  # [steps] from the target, farther than where it began
SWAPS = 3  # changes of direction in that time make a swing


@dataclass(frozen=True)
class Verdict:
    """The verdict on a step response.

    Args:
        kind: ``settles``, ``rings``, ``oscillates``, ``stays-short``, ``slow`` or ``runs-away``.
        reached: [s] until nine tenths of the step; None if never.
        overshoot: [of the step] how far it went past the target.
        settled: [s] until it stays within a twentieth of the step; None if not while watched.
        left: [of the step] how far from the target it ended; below zero is past it.
        swing: [of the step] how far it still went to and fro at the end.
        duration: [s].
    """

    kind: str
    reached: float | None
    overshoot: float
    settled: float | None
    left: float
    swing: float
    duration: float

    @property
    def is_good(self) -> bool:
        """Whether these gains are a good start."""
        return self.kind == "settles"

    @property
    def description(self) -> str:
        """The verdict as a clause in words."""
        match self.kind:
            case "settles" | "rings":
                past = (
                    f", goes {self.overshoot:.0%} past the target" if self.overshoot > BAND else ""
                )
                return (
                    f"reaches 90% of the target after {_time(self.reached)}{past} and settles "
                    f"after {_time(self.settled)}"
                )
            case "oscillates":
                return (
                    f"oscillates and does not settle: it still swings by {self.swing:.0%} of "
                    f"the step after {_time(self.duration)}"
                )
            case "stays-short":
                return f"stops {self.left:.0%} of the step before the target"
            case "runs-away":
                return "moves away from the target"
            case _:
                return (
                    f"is slow: still {abs(self.left):.0%} of the step from the target after "
                    f"{_time(self.duration)}"
                )

    def to_json(self) -> dict[str, object]:
        """The verdict as plain data."""
        return {
            "verdict": self.kind,
            "reached_s": self.reached,
            "overshoot": self.overshoot,
            "settled_s": self.settled,
        }


def judge_step_response(response: StepResponse) -> Verdict:
    """Judge a step response: rise, overshoot, settling and saturation.

    Args:
        response: of a target that is not zero.
    """
    share = [value / response.target for value in response.value]
    time, watched = response.time, response.time[-1]
    reached = next((t for t, y in zip(time, share, strict=True) if y >= NEARLY), None)
    outside = [k for k, y in enumerate(share) if abs(y - 1.0) > BAND]
    settled = time[min(outside[-1] + 1, len(time) - 1)] if outside else 0.0
    end = share[int((1.0 - LAST) * len(share)) :]
    swing = max(end) - min(end)
    late = settled > (1.0 - LAST) * watched
    overshoot = max(0.0, max(share) - 1.0)
    return Verdict(
        _kind(end, late=late, overshoot=overshoot, swing=swing),
        reached,
        overshoot,
        None if late else settled,
        1.0 - share[-1],
        swing,
        watched,
    )


def _kind(end: list[float], *, late: bool, overshoot: float, swing: float) -> str:
    if not late:
        return "rings" if overshoot > RINGS else "settles"
    if _swaps(end) >= SWAPS and swing > BAND:
        return "oscillates"
    if abs(end[-1] - 1.0) > AWAY + BAND:
        return "runs-away"
    return "stays-short" if swing < STILL and end[-1] < 1.0 else "slow"


def _swaps(values: list[float]) -> int:
    """How often it turns round."""
    ways = [after - before for before, after in pairwise(values) if after != before]
    return sum(1 for before, after in pairwise(ways) if before * after < 0.0)


def _time(seconds: float | None) -> str:
    if seconds is None:
        return "more than was watched"
    return f"{seconds * 1000:.0f} ms" if seconds < 1.0 else f"{seconds:.2g} s"
