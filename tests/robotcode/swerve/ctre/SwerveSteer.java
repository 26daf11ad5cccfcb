package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.SignalLogger;
import com.ctre.phoenix6.swerve.SwerveRequest;
import edu.wpi.first.wpilibj2.command.Subsystem;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import frc.robot.generated.TunerConstants.TunerSwerveDrivetrain;

/** The wheels turn in place; a shorter test than the generator's. */
public class SwerveSteer extends TunerSwerveDrivetrain implements Subsystem {
    private final SwerveRequest.SysIdSwerveSteerGains m_steer =
        new SwerveRequest.SysIdSwerveSteerGains();

    private final SysIdRoutine m_routine = new SysIdRoutine(
        new SysIdRoutine.Config(
            Volts.of(0.5).per(Second), Volts.of(3), Seconds.of(6),
            state -> SignalLogger.writeString("SysIdSteer_State", state.toString())),
        new SysIdRoutine.Mechanism(volts -> setControl(m_steer.withVolts(volts)), null, this));
}
