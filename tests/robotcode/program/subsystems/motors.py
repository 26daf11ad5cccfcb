from rev import SparkMax


def make_motor(channel):
    return SparkMax(channel, SparkMax.MotorType.kBrushless)
