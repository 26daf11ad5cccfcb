import commands2
from phoenix6 import controls, hardware


class Arm(commands2.SubsystemBase):
    RAMP = 0.5
    STEP = 7 / 2

    def __init__(self):
        super().__init__()
        self.motor = hardware.TalonFX(5)
        self.second = hardware.TalonFX(6)
        self.second.set_control(controls.Follower(self.motor.device_id, True))
        self.request = controls.VoltageOut(0)
        self.routine = commands2.sysid.SysIdRoutine(
            commands2.sysid.SysIdRoutine.Config(self.RAMP, Arm.STEP, 10),
            commands2.sysid.SysIdRoutine.Mechanism(self.set_volts, self.log, self, "arm"),
        )

    def set_volts(self, volts):
        self.motor.set_control(self.request.with_output(volts))

    def log(self, log):
        motor = log.motor("arm")
        motor = motor.voltage(self.motor.get_motor_voltage().value)
        motor.angularPosition(self.position)
        motor.angularVelocity(self.motor.get_velocity().value_as_double)

    @property
    def position(self):
        return self.motor.get_position().value_as_double
