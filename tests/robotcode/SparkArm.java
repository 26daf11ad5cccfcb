package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.SparkBase.ControlType;
import com.revrobotics.spark.SparkBase.PersistMode;
import com.revrobotics.spark.SparkBase.ResetMode;
import com.revrobotics.spark.SparkClosedLoopController;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import com.revrobotics.spark.config.SparkMaxConfig;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.Subsystem;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Config;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Mechanism;

public class SparkArm implements Subsystem {
  private static final class Characterization {
    static final double kRampVoltsPerSecond = .5;
    static final double kStepVolts = 7.0 / 2;
    static final int kTimeoutMs = 10_000;
  }

  private final SparkMax m_motor = new SparkMax(5, MotorType.kBrushless);
  private final SparkMax m_second = new SparkMax(6, MotorType.kBrushless);
  private final RelativeEncoder m_encoder = m_motor.getEncoder();
  private final SparkClosedLoopController m_controller = m_motor.getClosedLoopController();
  private final SysIdRoutine m_routine;

  public SparkArm() {
    var leaderConfig = new SparkMaxConfig();
    leaderConfig.smartCurrentLimit(40).voltageCompensation(12);
    m_motor.configure(leaderConfig, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters);
    var config = new SparkMaxConfig();
    config.apply(leaderConfig).follow(m_motor, true);
    m_second.configure(config, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters);

    var sysId =
        new Config(
            Volts.per(Second).of(Characterization.kRampVoltsPerSecond),
            Units.Volts.of(Characterization.kStepVolts),
            Units.Milliseconds.of(Characterization.kTimeoutMs));
    m_routine = new SysIdRoutine(sysId, new Mechanism(this::drive, this::record, this, "arm"));
  }

  private void drive(Voltage voltage) {
    m_controller.setReference(voltage.in(Volts), ControlType.kVoltage);
  }

  private void record(SysIdRoutineLog log) {
    var arm = log.motor("arm");
    arm.voltage(appliedVoltage());
    arm.angularPosition(Rotations.of(m_encoder.getPosition()));
    arm.angularVelocity(RPM.of(m_encoder.getVelocity()));
  }

  private Voltage appliedVoltage() {
    return Volts.of(m_motor.getAppliedOutput() * m_motor.getBusVoltage());
  }
}
