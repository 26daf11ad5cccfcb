package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.SparkBase.PersistMode;
import com.revrobotics.spark.SparkBase.ResetMode;
import com.revrobotics.spark.SparkFlex;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.config.SparkFlexConfig;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

public class ShooterFlex extends SubsystemBase {
  private final SparkFlex m_top = new SparkFlex(11, MotorType.kBrushless);
  private final SparkFlex m_bottom = new SparkFlex(12, MotorType.kBrushless);
  private final RelativeEncoder m_encoder = m_top.getEncoder();

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(),
          new SysIdRoutine.Mechanism(
              m_top::setVoltage,
              log ->
                  log.motor("shooter")
                      .voltage(Volts.of(m_top.getAppliedOutput() * m_top.getBusVoltage()))
                      .angularPosition(Rotations.of(m_encoder.getPosition()))
                      .angularVelocity(RPM.of(m_encoder.getVelocity())),
              this));

  public ShooterFlex() {
    SparkFlexConfig following = new SparkFlexConfig();
    following.follow(m_top, true);
    m_bottom.configure(
        following, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters);
  }
}
