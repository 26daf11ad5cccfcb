package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.VoltageUnit;
import edu.wpi.first.units.measure.Time;
import edu.wpi.first.units.measure.Velocity;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

public class NestedConstants extends SubsystemBase {
  /** What the tests look like. */
  public static final class SysId {
    static final Velocity<VoltageUnit> kRamp = Volts.of(1).per(Second).times(0.5);
    static final double kStepVolts = 7.0 / 2;
    static final Voltage kStep = Volts.of(kStepVolts);
    static final Time kTimeout = Minutes.of(1).div(6);

    private SysId() {}
  }

  private final TalonFX m_motor = new TalonFX(1);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(SysId.kRamp, SysId.kStep, SysId.kTimeout),
          new SysIdRoutine.Mechanism(this::run, this::record, this));

  private void run(final Voltage volts) {
    m_motor.setVoltage(volts.magnitude());
  }

  private void record(final edu.wpi.first.wpilibj.sysid.SysIdRoutineLog log) {
    final var name = getName() + "-motor";
    log.motor(name).voltage(m_motor.getMotorVoltage().getValue());
  }
}
