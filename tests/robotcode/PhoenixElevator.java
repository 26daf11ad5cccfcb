package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.SignalLogger;
import com.ctre.phoenix6.controls.Follower;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

public class PhoenixElevator extends SubsystemBase {
  private final TalonFX m_leader = new TalonFX(10, "canivore");
  private final TalonFX m_follower = new TalonFX(11, "canivore");
  private final VoltageOut m_request = new VoltageOut(0.0).withEnableFOC(true);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(
              null, // 1 V/s
              Volts.of(4),
              null, // 10 s
              state -> SignalLogger.writeString("state", state.toString())),
          new SysIdRoutine.Mechanism(
              volts -> m_leader.setControl(m_request.withOutput(volts.in(Volts))), null, this));

  public PhoenixElevator() {
    m_follower.setControl(new Follower(m_leader.getDeviceID(), true));
  }
}
