import com.sun.source.util.JavacTask;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import javax.tools.Diagnostic;
import javax.tools.DiagnosticCollector;
import javax.tools.JavaCompiler;
import javax.tools.JavaFileObject;
import javax.tools.StandardJavaFileManager;
import javax.tools.ToolProvider;

/**
 * Compiles programs one after another in one process.
 *
 * <p>Each line of the input is one program: the folder of the stubs to compile it against, and its
 * files, separated by tabs. Each line of the output is one error: the program's number from 0, the
 * file, the line and the message, separated by tabs.
 */
public final class CompileEach {
  private static final JavaCompiler COMPILER = ToolProvider.getSystemJavaCompiler();
  private static final Map<Path, Path> CLASSES = new HashMap<>();

  private CompileEach() {}

  public static void main(String[] arguments) throws IOException {
    var input = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
    var output = new PrintStream(System.out, true, StandardCharsets.UTF_8);
    int number = 0;
    for (String line = input.readLine(); line != null; line = input.readLine()) {
      String[] parts = line.split("\t");
      var sources = new ArrayList<Path>();
      for (String name : List.of(parts).subList(1, parts.length)) {
        sources.add(Path.of(name));
      }
      for (var error : errors(sources, classes(Path.of(parts[0])), null)) {
        String file = error.getSource() == null ? "" : error.getSource().getName();
        String said = error.getMessage(Locale.ROOT).replaceAll("\\s*\\R\\s*", "; ");
        output.println(number + "\t" + file + "\t" + error.getLineNumber() + "\t" + said);
      }
      number++;
    }
  }

  /** Returns the folder of the classes of some stubs, which are compiled when first asked for. */
  private static Path classes(Path stubs) throws IOException {
    Path made = CLASSES.get(stubs);
    if (made == null) {
      made = Files.createDirectory(stubs.resolveSibling(stubs.getFileName() + "-classes"));
      List<Path> sources;
      try (var found = Files.walk(stubs)) {
        sources = found.filter(path -> path.toString().endsWith(".java")).toList();
      }
      var wrong = errors(sources, made, made);
      if (!wrong.isEmpty()) {
        throw new IllegalStateException("the stubs do not compile: " + wrong);
      }
      CLASSES.put(stubs, made);
    }
    return made;
  }

  /** Compiles files; without a folder for what comes out, they are only checked. */
  private static List<Diagnostic<? extends JavaFileObject>> errors(
      List<Path> sources, Path classes, Path out) throws IOException {
    var options = new ArrayList<>(List.of("-proc:none", "-Xlint:none", "-classpath", classes + ""));
    if (out != null) {
      options.addAll(List.of("-d", out.toString()));
    }
    var found = new DiagnosticCollector<JavaFileObject>();
    try (StandardJavaFileManager files =
        COMPILER.getStandardFileManager(found, Locale.ROOT, StandardCharsets.UTF_8)) {
      var task =
          (JavacTask)
              COMPILER.getTask(
                  null, files, found, options, null, files.getJavaFileObjectsFromPaths(sources));
      if (out == null) {
        task.analyze();
      } else {
        task.call();
      }
    }
    return found.getDiagnostics().stream()
        .filter(one -> one.getKind() == Diagnostic.Kind.ERROR)
        .toList();
  }
}
