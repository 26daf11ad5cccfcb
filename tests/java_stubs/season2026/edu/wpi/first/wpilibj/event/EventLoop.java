// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/event/EventLoop.java

package edu.wpi.first.wpilibj.event;

public final class EventLoop {
  public native void poll();

  public native void clear();
}
