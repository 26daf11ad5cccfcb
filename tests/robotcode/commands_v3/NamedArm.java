package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.measure.Voltage;

/** The name is handed up, and a second one goes to the routine. */
public final class NamedArm extends Mechanism {
  private static final double GEARING = 60.0;

  private final TalonFX joint = new TalonFX(31);
  private final SysIdRoutine sysId;

  public NamedArm() {
    super("Arm");
    sysId =
        new SysIdRoutine(
            SysIdRoutine.Config.useDataLog(
                Volts.of(0.25).per(Second), Volts.of(1.5), Seconds.of(5)),
            new SysIdRoutine.SysIdMechanism(this::push, this::write, this, "arm"));
  }

  private void push(Voltage volts) {
    joint.setVoltage(volts.in(Volts));
  }

  private void write(SysIdRoutineLog log) {
    var arm = log.motor("arm");
    arm.voltage(Volts.of(joint.getMotorVoltage().getValueAsDouble()));
    arm.angularPosition(Rotations.of(joint.getPosition().getValueAsDouble() / GEARING));
    arm.angularVelocity(RotationsPerSecond.of(joint.getVelocity().getValueAsDouble() / GEARING));
  }
}
