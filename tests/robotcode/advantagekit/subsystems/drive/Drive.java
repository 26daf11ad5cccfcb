package subsystems.drive;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.BaseStatusSignal;
import com.ctre.phoenix6.StatusSignal;
import com.ctre.phoenix6.configs.TalonFXConfiguration;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import com.ctre.phoenix6.signals.InvertedValue;
import com.ctre.phoenix6.signals.NeutralModeValue;
import edu.wpi.first.math.filter.Debouncer;
import edu.wpi.first.units.measure.Angle;
import edu.wpi.first.units.measure.AngularVelocity;
import edu.wpi.first.units.measure.Current;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.Alert;
import edu.wpi.first.wpilibj.Alert.AlertType;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import org.littletonrobotics.junction.AutoLog;
import org.littletonrobotics.junction.AutoLogOutput;
import org.littletonrobotics.junction.Logger;

public class Drive extends SubsystemBase {
  private final ModuleIO[] io;
  private final ModuleIOInputsAutoLogged[] inputs;
  private final Alert[] disconnected;
  private final SysIdRoutine sysId;

  public Drive() {
    this(new ModuleIOTalonFX(1, InvertedValue.CounterClockwise_Positive),
        new ModuleIOTalonFX(2, InvertedValue.Clockwise_Positive));
  }

  public Drive(ModuleIO... modules) {
    io = modules;
    inputs = new ModuleIOInputsAutoLogged[io.length];
    disconnected = new Alert[io.length];
    for (int i = 0; i < io.length; i++) {
      inputs[i] = new ModuleIOInputsAutoLogged();
      disconnected[i] = new Alert("Module " + i + " disconnected", AlertType.kError);
    }
    sysId =
        new SysIdRoutine(
            new SysIdRoutine.Config(
                Volts.per(Second).of(0.5),
                Volts.of(3.5),
                Seconds.of(10.0),
                (state) -> Logger.recordOutput("Drive/SysIdState", state.toString())),
            new SysIdRoutine.Mechanism(
                (voltage) -> runCharacterization(voltage.in(Volts)),
                (log) -> {
                  for (int i = 0; i < io.length; i++) {
                    io[i].updateInputs(inputs[i]);
                    log.motor("module-" + i)
                        .voltage(Volts.of(inputs[i].appliedVolts))
                        .linearPosition(Meters.of(inputs[i].positionRad * 0.0508))
                        .linearVelocity(MetersPerSecond.of(inputs[i].velocityRadPerSec * 0.0508));
                  }
                },
                this));
  }

  @Override
  public void periodic() {
    for (int i = 0; i < io.length; i++) {
      io[i].updateInputs(inputs[i]);
      Logger.processInputs("Drive/Module" + i, inputs[i]);
      disconnected[i].set(!inputs[i].connected);
    }
  }

  public void runCharacterization(double output) {
    for (var module : io) {
      module.setVoltage(output);
    }
  }

  @AutoLogOutput(key = "Drive/MeanVelocity")
  public double getFFCharacterizationVelocity() {
    double output = 0.0;
    for (int i = 0; i < 2; i++) {
      output += inputs[i].velocityRadPerSec / 2.0;
    }
    return output;
  }

  public Command sysIdQuasistatic(SysIdRoutine.Direction direction) {
    return run(() -> runCharacterization(0.0))
        .withTimeout(1.0)
        .andThen(sysId.quasistatic(direction));
  }

  public Command sysIdDynamic(SysIdRoutine.Direction direction) {
    return run(() -> runCharacterization(0.0)).withTimeout(1.0).andThen(sysId.dynamic(direction));
  }
}

interface ModuleIO {
  @AutoLog
  public static class ModuleIOInputs {
    public boolean connected = false;
    public double positionRad = 0.0;
    public double velocityRadPerSec = 0.0;
    public double appliedVolts = 0.0;
    public double currentAmps = 0.0;
  }

  public default void updateInputs(ModuleIOInputs inputs) {}

  public default void setVoltage(double volts) {}
}

class ModuleIOTalonFX implements ModuleIO {
  private static final double GEAR_RATIO = 6.75;
  private final TalonFX talon;
  private final VoltageOut voltageRequest = new VoltageOut(0);
  private final StatusSignal<Angle> position;
  private final StatusSignal<AngularVelocity> velocity;
  private final StatusSignal<Voltage> appliedVolts;
  private final StatusSignal<Current> current;
  private final Debouncer connectedDebounce = new Debouncer(0.5);

  ModuleIOTalonFX(int id, InvertedValue inverted) {
    talon = new TalonFX(id, "rio");
    var config = new TalonFXConfiguration();
    config.MotorOutput.NeutralMode = NeutralModeValue.Brake;
    config.MotorOutput.Inverted = inverted;
    config.Feedback.SensorToMechanismRatio = GEAR_RATIO;
    config.CurrentLimits.StatorCurrentLimit = 80.0;
    config.CurrentLimits.StatorCurrentLimitEnable = true;
    config.ClosedLoopRamps.TorqueClosedLoopRampPeriod = 0.02;
    for (int attempt = 0; attempt < 5; attempt++) {
      if (talon.getConfigurator().apply(config, 0.25).isOK()) break;
    }
    position = talon.getPosition();
    velocity = talon.getVelocity();
    appliedVolts = talon.getMotorVoltage();
    current = talon.getStatorCurrent();
    BaseStatusSignal.setUpdateFrequencyForAll(100.0, position, velocity, appliedVolts, current);
    talon.optimizeBusUtilization();
  }

  @Override
  public void updateInputs(ModuleIOInputs inputs) {
    var status = BaseStatusSignal.refreshAll(position, velocity, appliedVolts, current);
    inputs.connected = connectedDebounce.calculate(status.isOK());
    inputs.positionRad = position.getValue().in(Radians);
    inputs.velocityRadPerSec = velocity.getValue().in(RadiansPerSecond);
    inputs.appliedVolts = appliedVolts.getValueAsDouble();
    inputs.currentAmps = current.getValueAsDouble();
  }

  @Override
  public void setVoltage(double volts) {
    talon.setControl(voltageRequest.withOutput(volts).withEnableFOC(true));
  }
}
