"""Backlash: free play between motor and load.

    the motor pushes the load only after it has crossed the slack

Gear lash, a loose hex shaft, a chain with slack: at every start and change of direction the motor
first moves alone, with its own inertia (``share`` of kA) and its own friction (``motor_friction``
of all), then the teeth meet. Teeth cannot pull, so with ``damping`` ζ they part with

    exp(-ζ/√(1 - ζ²)·(π - φ))        φ = atan2(2ζ√(1 - ζ²), 1 - 2ζ²)

of the speed they met with: 0.45 of it for 0.3, 0.69 for 0.13 (Schwager and Pöschel, "Coefficient
of restitution and linear-dashpot model revisited", 2007).
"""

from collections.abc import Iterator, Mapping

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

TIMES = (0.001, 0.002, 0.004, 0.008, 0.016, 0.03)  # [s] at top speed, through the backlash
BOUNCE = 0.13  # [1] damping of hard teeth
LIGHT, HEAVY = 0.2, 0.5  # [1] shares of kA: a search from one seldom finds the other


def backlash_gap(slack: float) -> float:
    """[unit] free play between the teeth: the parameter ``slack`` itself."""
    return slack


def motor_inertia_share(share: float) -> float:
    """[1] share of the inertia on the motor's side: the parameter ``share`` itself."""
    return share


def joint_damping(damping: float) -> float:
    """[1] damping while the teeth touch, as a share of critical damping."""
    return damping


def motor_friction_share(motor_friction: float) -> float:
    """[1] share of the friction on the motor's side: the parameter ``motor_friction`` itself."""
    return motor_friction


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is 10 ms of play at the speed of a step."""
    slack = 0.01 * scale.speed * size
    return {"slack": slack, "share": 0.25, "damping": 0.3, "motor_friction": 0.25}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: some milliseconds at top speed, with several shares of kA in the motor."""
    for share in (LIGHT, HEAVY):
        for time in TIMES:
            slack = time * max(residual.top_speed, 1e-6)
            yield {"slack": slack, "share": share, "damping": BOUNCE, "motor_friction": 0.25}


EFFECT = Effect(
    name="backlash",
    kind="two-body",
    summary="free play between motor and load (gear lash, loose chain)",
    formula="motor and load meet only where they are slack/2 apart",
    parameters=(
        Parameter("slack", "play from tooth to tooth", "{u}", power=-1, most=1e3),
        Parameter("share", "inertia on the motor's side", "1", least=0.01, most=0.95, neutral=0.25),
        Parameter(
            "damping",
            "damping of teeth that touch, of critical",
            "1",
            least=0.01,
            most=1.0,
            neutral=0.3,
        ),
        Parameter("motor_friction", "friction on the motor's side", "1", most=1.0, neutral=0.25),
    ),
    fingerprint="After every start or change of direction the velocity jumps up, drops, and is "
    "then normal.",
    inspect="Check gears, hex shafts and chains for free play: hold the motor, and turn the "
    "mechanism by hand.",
    apart={
        "compliance": (
            "Change direction with two sizes of step, and log every 5 ms. Free play stays the "
            "same, but a spring bends further with the larger step."
        ),
        "stribeck": (
            "Run a triangle test. Free play shows at each change of direction, Stribeck friction "
            "shows at each start."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={
        "backlash_gap": backlash_gap,
        "joint_damping": joint_damping,
        "motor_friction_share": motor_friction_share,
        "motor_inertia_share": motor_inertia_share,
    },
)
