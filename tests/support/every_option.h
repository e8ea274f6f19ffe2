// A program with an option of every kind.
#pragma once

#include "core/options.h"

namespace phos::test {

struct EveryOption {
  bool flag = false;
  double number = 0.2;
  std::optional<double> maybe;
  std::int64_t count = 10;
  std::string word, path, input;
  std::vector<std::string> items, more;
  enum class Shape { hull, disc } shape = Shape::hull;
  Options options{"phos-x", "does x", "Does x at length."};
  explicit EveryOption(bool scene_required = true) {
    options.input("SCENE", input, "a scene", scene_required);
    options.inputs("MORE", more, "more scenes", false);
    options.flag("flag", flag, "a flag");
    options.number("number", number, "METRES", "a number", kPositive);
    options.number("maybe", maybe, "M", "a number that may be absent");
    options.integer("count", count, "N", "a count", {0, 100});
    options.text("word", word, "WORD", "a word");
    options.list("items", items, "LIST", "items");
    options.file("output,o", path, "where to");
    options.choice<Shape>("shape", shape, {{"hull", Shape::hull}, {"disc", Shape::disc}}, "a shape");
  }
};

}  // namespace phos::test
