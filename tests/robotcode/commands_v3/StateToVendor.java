package first.robot.mechanisms;

import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.SignalLogger;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** All four arguments: two of WPILib's constants, and the state goes into the vendor's log. */
public class StateToVendor extends Mechanism {
  private final TalonFX m_shooter = new TalonFX(20);
  private final VoltageOut m_request = new VoltageOut(0).withEnableFOC(true);

  private final SysIdRoutine m_sysId =
      new SysIdRoutine(
          new SysIdRoutine.Config(
              SysIdRoutine.Config.DEFAULT_RAMP_RATE,
              Volts.of(4),
              SysIdRoutine.Config.DEFAULT_TIMEOUT,
              state -> SignalLogger.writeString("SysIdShooter_State", state.toString())),
          new SysIdRoutine.SysIdMechanism(
              volts -> m_shooter.setControl(m_request.withOutput(volts)), null, this, "shooter"));
}
