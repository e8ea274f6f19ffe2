#include "file/json_parse.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text/line.h"
#include "file/limits.h"

namespace phos::inline file {

namespace {

/// Builds a Json from the parser's events. Returning false stops the parser.
class Builder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  bool null() { return put(Json()); }
  bool boolean(bool v) { return put(v); }
  /// Negative ones; -0 is none of the integers.
  bool number_integer(number_integer_t v) {
    return put(v == 0 ? Json(-0.0) : Json(static_cast<std::int64_t>(v)));
  }
  bool number_unsigned(number_unsigned_t v) {
    if (v > static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max()))
      return put(Json(static_cast<double>(v)));
    return put(Json(static_cast<std::int64_t>(v)));
  }
  bool number_float(number_float_t v, const string_t&) { return put(Json(v)); }
  bool string(string_t& v) { return put(Json(std::move(v))); }
  bool binary(binary_t&) { return false; }
  bool start_object(std::size_t) { return open(true); }
  bool start_array(std::size_t) { return open(false); }
  bool key(string_t& name) {
    Level& level = levels_.back();
    if (level.object.contains(name)) {
      error = "the name \"" + name + "\" appears twice in one object";
      return false;
    }
    level.key = std::move(name);
    return true;
  }
  bool end_object() {
    Json done(std::move(levels_.back().object));
    levels_.pop_back();
    return put(std::move(done));
  }
  bool end_array() {
    Json done(std::move(levels_.back().array));
    levels_.pop_back();
    return put(std::move(done));
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& e) {
    const std::string what =
        e.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: reason"
    const std::size_t colon = what.find(": ");
    const std::size_t bracket = what.find("] ");
    const std::size_t begin = colon != std::string::npos     ? colon + 2
                              : bracket != std::string::npos ? bracket + 2
                                                             : 0;
    error = text("at byte ", position, ": ", what.substr(begin));
    return false;
  }

  Json root;
  std::string error;

 private:
  struct Level {
    bool is_object;
    Json::Object object;
    Json::Array array;
    std::string key;
  };

  bool open(bool is_object) {
    if (levels_.size() == kMostJsonLevels.as<std::size_t>()) {
      error = text("nested deeper than ", written(kMostJsonLevels), " levels");
      return false;
    }
    levels_.push_back({is_object, {}, {}, {}});
    return true;
  }

  bool put(Json v) {
    if (levels_.empty()) {
      root = std::move(v);
    } else if (levels_.back().is_object) {
      levels_.back().object.emplace(std::move(levels_.back().key), std::move(v));
    } else {
      levels_.back().array.push_back(std::move(v));
    }
    return true;
  }

  std::vector<Level> levels_;
};

}  // namespace

Json parse_json(std::string_view s, const std::string& where) {
  // The parser takes a zero byte for the end and would ignore the rest.
  if (const std::size_t zero = s.find('\0'); zero != std::string_view::npos)
    throw Error(ExitCode::bad_input, where, text("malformed JSON at byte ", zero + 1, ": a zero byte"));
  Builder builder;
  if (!nlohmann::json::sax_parse(s.begin(), s.end(), &builder))
    throw Error(ExitCode::bad_input, where, "malformed JSON " + one_line(builder.error));
  return std::move(builder.root);
}

}  // namespace phos::inline file
