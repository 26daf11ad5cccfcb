"""The verdict on a step response, in a few numbers and in words."""

from dataclasses import dataclass
from itertools import pairwise

from sim.feedback.response import StepResponse

NEARLY = 0.9  # [share of the step] at which the target counts as reached
BAND = 0.05  # [share of the step] around the target that counts as settled
RINGING = 0.25  # [share of the step] a larger overshoot is not a good start
LAST = 0.3  # [share of the simulated time] at its end, in which a good loop has settled
STILL = 0.01  # [share of the step] a smaller motion in that time counts as standing
START_DISTANCE = 1.0  # [steps] distance from the target at the start; farther away, it moves away
TURNS = 3  # changes of direction in that time that count as oscillation


@dataclass(frozen=True)
class Verdict:
    """The verdict on a step response.

    Args:
        kind: ``settles``, ``rings``, ``oscillates``, ``stays-short``, ``slow`` or ``runs-away``.
        reached: rise time to 90 % of the step [s]; None if never.
        overshoot: largest overshoot [share of the step].
        settled: settling time to within 5 % of the step [s]; None if it does not settle in time.
        left: final error [share of the step]; negative past the target.
        swing: range of the values at the end [share of the step].
        duration: simulated time [s].
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
    def past_target(self) -> str:
        """A clause if it goes past the target by more than the band in which it settles."""
        return f", goes {self.overshoot:.0%} past the target" if self.overshoot > BAND else ""

    @property
    def description(self) -> str:
        """The verdict as a clause in words."""
        match self.kind:
            case "settles" | "rings":
                return (
                    f"reaches 90% of the target after {_format_time(self.reached)}"
                    f"{self.past_target} and settles after {_format_time(self.settled)}"
                )
            case "oscillates":
                return (
                    f"oscillates and does not settle: it still swings by {self.swing:.0%} of "
                    f"the step after {_format_time(self.duration)}"
                )
            case "stays-short":
                return f"stops {self.left:.0%} of the step before the target"
            case "runs-away":
                return "moves away from the target"
            case _:
                return (
                    f"is slow: still {abs(self.left):.0%} of the step from the target after "
                    f"{_format_time(self.duration)}"
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
    """Judge a step response by rise time, overshoot, settling time and oscillation.

    Args:
        response: the step response to a target that is not zero.
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
        _classify(end, late=late, overshoot=overshoot, swing=swing),
        reached,
        overshoot,
        None if late else settled,
        1.0 - share[-1],
        swing,
        watched,
    )


def _classify(end: list[float], *, late: bool, overshoot: float, swing: float) -> str:
    if not late:
        return "rings" if overshoot > RINGING else "settles"
    if _count_turns(end) >= TURNS and swing > BAND:
        return "oscillates"
    if abs(end[-1] - 1.0) > START_DISTANCE + BAND:
        return "runs-away"
    return "stays-short" if swing < STILL and end[-1] < 1.0 else "slow"


def _count_turns(values: list[float]) -> int:
    """The number of changes of direction."""
    ways = [after - before for before, after in pairwise(values) if after != before]
    return sum(1 for before, after in pairwise(ways) if before * after < 0.0)


def _format_time(seconds: float | None) -> str:
    if seconds is None:
        return "more than was watched"
    return f"{seconds * 1000:.0f} ms" if seconds < 1.0 else f"{seconds:.2g} s"
