public class Latin1 {
  // Geschwindigkeit für den Arm
}
