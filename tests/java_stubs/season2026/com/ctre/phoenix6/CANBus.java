// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/CANBus.html

package com.ctre.phoenix6;

public class CANBus {
  public CANBus(String canbus) {}
}
