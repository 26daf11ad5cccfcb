// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/StatusCode.html

package com.ctre.phoenix6;

public enum StatusCode {
  OK
}
