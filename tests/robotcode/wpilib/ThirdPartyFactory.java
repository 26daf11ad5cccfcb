package frc.robot.subsystems;

import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Config;
import swervelib.SwerveDrive;
import swervelib.SwerveDriveTest;

/** A library makes the routine; this file only holds it. */
public class ThirdPartyFactory extends SubsystemBase {
  private SwerveDrive m_swerve;

  public Command sysIdDriveMotorCommand() {
    SysIdRoutine routine =
        SwerveDriveTest.setDriveSysIdRoutine(new Config(), this, m_swerve, 12, true);
    return SwerveDriveTest.generateSysIdCommand(routine, 3.0, 5.0, 3.0);
  }
}
