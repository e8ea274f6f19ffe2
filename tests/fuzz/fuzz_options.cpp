// Files of options (@FILE): what a command line may say, of every kind of option.
#include "core/options.h"
#include "reading.h"

namespace {

using namespace phos;

enum class Shape { hull, disc };

void parse(const std::string& path) {
  bool flag = false;
  double number = 0.2;
  std::optional<double> maybe;
  std::int64_t count = 5;
  std::string word, output, scene;
  std::vector<std::string> many, more;
  Shape shape = Shape::hull;
  Options options("phos-x", "does x", "At length.");
  options.flag("flag", flag, "a flag");
  options.number("number", number, "METRES", "a number", kPositive);
  options.number("maybe", maybe, "METRES", "a number that may be absent");
  options.integer("count", count, "N", "a whole number", {0, 100});
  options.text("word", word, "WORD", "a word");
  options.list("many", many, "A,B", "words");
  options.choice<Shape>("shape", shape, {{"hull", Shape::hull}, {"disc", Shape::disc}}, "a shape");
  options.file("output,o", output, "where it goes");
  options.input("SCENE", scene, "a scene", false);
  options.inputs("MORE", more, "others", false);
  const std::string argument = "@" + path;
  const char* const words[] = {"phos-x", argument.c_str()};
  if (!options.parse(2, words)) return;
  PHOS_CHECK(number > 0 && count >= 0 && count <= 100, number, " ", count);
  fuzz::use(options.recorded().dump());
  fuzz::use(options.command());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool silent = std::freopen("/dev/null", "w", stdout) != nullptr;  // --help is printed
  static_cast<void>(silent);
  const std::string path = fuzz::spilled(fuzz::characters(data, size), "options");
  try {
    parse(path);
  } catch (const Error& e) {
    // Of the words in it, not of the file.
    if (e.code() != ExitCode::usage || std::string(e.what()).find('\n') != std::string::npos)
      fuzz::require_answer(e);
  }
  return 0;
}
