package frc.robot.subsystems.drive;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import org.littletonrobotics.junction.Logger;

/** The same style with the hardware in sight: the motors stand in the drive itself. */
public class OneModuleDrive extends SubsystemBase {
  private final TalonFX left = new TalonFX(1);
  private final TalonFX right = new TalonFX(2);
  private final VoltageOut request = new VoltageOut(0);
  private final SysIdRoutine sysId;

  public OneModuleDrive() {
    sysId =
        new SysIdRoutine(
            new SysIdRoutine.Config(
                Volts.of(0.5).per(Second),
                Volts.of(2.0),
                Seconds.of(10),
                (state) -> Logger.recordOutput("Drive/SysIdState", state.toString())),
            new SysIdRoutine.Mechanism(
                (voltage) -> runCharacterization(voltage.in(Volts)), null, this));
  }

  public void runCharacterization(double output) {
    left.setControl(request.withOutput(output));
    right.setControl(request.withOutput(output));
  }
}
