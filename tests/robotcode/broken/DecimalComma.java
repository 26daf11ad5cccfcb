public class DecimalComma {
  public static final class CharacterizationConstants {
    public static final double kS = 0,1937; // V
  }
}
