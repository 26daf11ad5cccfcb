package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.ctre.phoenix.motorcontrol.ControlMode;
import com.ctre.phoenix.motorcontrol.can.WPI_TalonSRX;
import com.ctre.phoenix.motorcontrol.can.WPI_VictorSPX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

public class OldTalon extends SubsystemBase {
	private final WPI_TalonSRX master = new WPI_TalonSRX(1);
	private final WPI_TalonSRX other = new WPI_TalonSRX(2);
	private final WPI_VictorSPX slave = new WPI_VictorSPX(3);

	private final SysIdRoutine routine;

	public OldTalon() {
		slave.follow(master);
		routine = new SysIdRoutine(
			new SysIdRoutine.Config(Volts.of(1).per(Second), Volts.of(5), Seconds.of(8)),
			new SysIdRoutine.Mechanism(volts -> {
				master.set(ControlMode.PercentOutput, volts.in(Volts) / 12.0);
				other.setVoltage(volts.in(Volts));
			}, log -> {
				log.motor("master").voltage(Volts.of(master.getMotorOutputVoltage()));
			}, this));
	}
}
