// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/ControlRequest.html

package com.ctre.phoenix6.controls;

public abstract class ControlRequest {}
