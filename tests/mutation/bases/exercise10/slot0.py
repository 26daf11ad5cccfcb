"""The student ann's shooter: Phoenix 6 counts rotations, as the analyzer did."""

from phoenix6.configs import Slot0Configs


class CharacterizationConstants:
    """Measured with a fresh battery; measure again when the mechanism changes."""

    kS = 0.08992  # V
    kV = 0.1645  # V·s/rot of the wheel
    kA = 0.03118  # V·s²/rot of the wheel
    kP = 0.128  # the analyzer's suggestion: start here


slot0 = Slot0Configs()
slot0.k_s = CharacterizationConstants.kS
slot0.k_v = CharacterizationConstants.kV
slot0.k_a = CharacterizationConstants.kA
