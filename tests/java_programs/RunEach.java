import java.io.ByteArrayOutputStream;
import java.io.File;
import java.io.OutputStream;
import java.io.PrintStream;
import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Method;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.util.Arrays;
import java.util.Locale;
import javax.tools.ToolProvider;

/**
 * Compiles and runs many programs in one Java process.
 *
 * <p>The argument is a folder. Each of its folders holds one Main.java; what that program prints is
 * written beside it, to the file "prints". Errors of the compiler stand there after "??", and an
 * exception that the program does not catch stands there after "!!".
 */
public class RunEach {
  public static void main(String[] args) throws Exception {
    Locale.setDefault(Locale.US);
    File[] folders = new File(args[0]).listFiles(File::isDirectory);
    String[] errors = new String[folders.length];
    Arrays.parallelSetAll(errors, i -> compile(folders[i]));
    for (int i = 0; i < folders.length; i++) {
      byte[] prints =
          errors[i].isEmpty() ? run(folders[i]) : errors[i].getBytes(StandardCharsets.UTF_8);
      Files.write(new File(folders[i], "prints").toPath(), prints);
    }
  }

  private static String compile(File folder) {
    ByteArrayOutputStream said = new ByteArrayOutputStream();
    String source = new File(folder, "Main.java").getPath();
    int status =
        ToolProvider.getSystemJavaCompiler()
            .run(
                null, said, said, "-proc:none", "-nowarn", "-XDsuppressNotes", "--release", "17",
                "-encoding", "UTF-8", "-d", folder.getPath(), source);
    return status == 0 ? "" : "?? " + said.toString(StandardCharsets.UTF_8);
  }

  private static byte[] run(File folder) throws Exception {
    ByteArrayOutputStream printed = new ByteArrayOutputStream();
    System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
    PrintStream console = System.err;
    System.setErr(new PrintStream(OutputStream.nullOutputStream())); // does not count
    try (URLClassLoader loader = new URLClassLoader(new URL[] {folder.toURI().toURL()}, null)) {
      Method main = loader.loadClass("Main").getDeclaredMethod("main", String[].class);
      main.setAccessible(true);
      main.invoke(null, (Object) new String[0]);
    } catch (InvocationTargetException exception) {
      System.out.println("!! " + exception.getCause());
    } catch (ExceptionInInitializerError error) {
      System.out.println("!! " + error);
    } finally {
      System.setErr(console);
    }
    return printed.toByteArray();
  }
}
