package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** 射球机构：上下两个滚轮（先慢后快）。 */
public class Chinese extends SubsystemBase {
  private final TalonFX 上轮 = new TalonFX(1); // 编号一
  private final TalonFX 下轮 = new TalonFX(2); // 编号二

  // 每秒零点五伏；阶跃三点五伏；最长十秒。
  private final SysIdRoutine 辨识 = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          电压 -> {
            上轮.setVoltage(电压.in(Volts));
            下轮.setVoltage(电压.in(Volts));
          },
          记录 -> 记录.motor("上轮")
              .voltage(上轮.getMotorVoltage().getValue())
              .angularPosition(上轮.getPosition().getValue())
              .angularVelocity(上轮.getVelocity().getValue()),
          this));
}
