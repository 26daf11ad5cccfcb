// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/hardware/TalonFX.html

package com.ctre.phoenix6.hardware;

import com.ctre.phoenix6.CANBus;
import com.ctre.phoenix6.StatusCode;
import com.ctre.phoenix6.StatusSignal;
import com.ctre.phoenix6.configs.TalonFXConfigurator;
import com.ctre.phoenix6.controls.ControlRequest;
import edu.wpi.first.units.measure.Angle;
import edu.wpi.first.units.measure.AngularVelocity;
import edu.wpi.first.units.measure.Current;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.motorcontrol.MotorController;

public class TalonFX implements MotorController {
  public TalonFX(int deviceId) {}

  public TalonFX(int deviceId, CANBus canbus) {}

  public TalonFX(int deviceId, String canbus) {}

  public native void set(double speed);

  public native void setVoltage(double outputVolts);

  public native double get();

  public native void setInverted(boolean isInverted);

  public native boolean getInverted();

  public native void disable();

  public native void stopMotor();

  public native TalonFXConfigurator getConfigurator();

  public native int getDeviceID();

  public native StatusSignal<Voltage> getMotorVoltage();

  public native StatusSignal<Voltage> getSupplyVoltage();

  public native StatusSignal<Double> getDutyCycle();

  public native StatusSignal<Angle> getPosition();

  public native StatusSignal<AngularVelocity> getVelocity();

  public native StatusSignal<Current> getStatorCurrent();

  public native StatusCode setPosition(double newValue);

  public native StatusCode setControl(ControlRequest request);
}
