package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;
import static frc.robot.Constants.ArmConstants.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import frc.robot.Constants;

/** Constants of another file, by static import and by class; the step is a division of ints. */
public class Arm extends SubsystemBase {
  private final TalonFX m_arm = new TalonFX(kMotorId);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.of(kRampVoltsPerSecond).per(Second),
          Volts.of(Constants.ArmConstants.kSeven / Constants.kTwo),
          kSysIdTimeout),
      new SysIdRoutine.Mechanism((Voltage v) -> m_arm.setVoltage(v.in(Volts)), null, this));
}
