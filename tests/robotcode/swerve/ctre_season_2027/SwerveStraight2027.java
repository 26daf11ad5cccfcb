package first.robot.subsystems;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.SignalLogger;
import com.ctre.phoenix6.swerve.SwerveRequest;
import first.robot.generated.TunerConstants.TunerSwerveDrivetrain;
import org.wpilib.command2.Command;
import org.wpilib.command2.Subsystem;
import org.wpilib.command2.sysid.SysIdRoutine;

/** The generator for the season of 2027: other packages, the same routine. */
public class SwerveStraight2027 extends TunerSwerveDrivetrain implements Subsystem {
    private final SwerveRequest.SysIdSwerveTranslation straight =
        new SwerveRequest.SysIdSwerveTranslation();

    private final SysIdRoutine routine = new SysIdRoutine(
        new SysIdRoutine.Config(
            null,
            Volts.of(4),
            null,
            state -> SignalLogger.writeString("SysIdTranslation_State", state.toString())
        ),
        new SysIdRoutine.Mechanism(output -> setControl(straight.withVolts(output)), null, this)
    );

    public Command sysIdDynamic(SysIdRoutine.Direction direction) {
        return routine.dynamic(direction);
    }
}
