// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/Follower.html

package com.ctre.phoenix6.controls;

import com.ctre.phoenix6.signals.MotorAlignmentValue;

public class Follower extends ControlRequest {
  public Follower(int leaderID, MotorAlignmentValue motorAlignment) {}
}
