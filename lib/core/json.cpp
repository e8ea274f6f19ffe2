#include "core/json.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace phos {

namespace {

template <class T>
std::string shortest_number(T v) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, v);
  return error == std::errc() ? std::string(buffer, end) : "0";
}

template <class T, class V>
const T& get(const V& value, const char* wanted) {
  if (const T* v = std::get_if<T>(&value)) return *v;
  throw std::runtime_error(std::string("not ") + wanted);
}

void append_string(std::string& out, const std::string& s) {
  static constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  for (const char c : s) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\', out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (byte < 0x20) {
      out += "\\u00", out += kHex[byte >> 4], out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

void new_line(std::string& out, int indent, int depth) {
  if (indent == 0) return;
  out += '\n';
  out.append(static_cast<std::size_t>(indent * depth), ' ');
}

void append(std::string& out, const Json& v, int indent, int depth) {
  if (v.is_null()) {
    out += "null";
  } else if (v.is_bool()) {
    out += v.as_bool() ? "true" : "false";
  } else if (v.is_integer()) {
    out += std::to_string(v.as_integer());
  } else if (v.is_number()) {
    out += std::isfinite(v.as_number()) ? shortest(v.as_number()) : "null";
  } else if (v.is_string()) {
    append_string(out, v.as_string());
  } else if (v.is_array()) {
    out += '[';
    bool first = true;
    for (const Json& item : v.as_array()) {
      if (!first) out += ',';
      first = false;
      new_line(out, indent, depth + 1);
      append(out, item, indent, depth + 1);
    }
    if (!first) new_line(out, indent, depth);
    out += ']';
  } else {
    out += '{';
    bool first = true;
    for (const auto& [key, item] : v.as_object()) {
      if (!first) out += ',';
      first = false;
      new_line(out, indent, depth + 1);
      append_string(out, key);
      out += indent == 0 ? ":" : ": ";
      append(out, item, indent, depth + 1);
    }
    if (!first) new_line(out, indent, depth);
    out += '}';
  }
}

}  // namespace

std::string shortest(double v) { return shortest_number(v); }
std::string shortest(float v) { return shortest_number(v); }

Json::Json() = default;
Json::~Json() = default;
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
bool Json::operator==(const Json& other) const { return value_ == other.value_; }

Json::Json(float v) {
  // Through the float's own shortest text, so that 0.1f prints 0.1 and not 0.10000000149011612.
  double wide = v;
  if (std::isfinite(v)) {
    const std::string s = shortest(v);
    std::from_chars(s.data(), s.data() + s.size(), wide);
  }
  value_ = wide;
}

bool Json::as_bool() const { return get<bool>(value_, "a boolean"); }
std::int64_t Json::as_integer() const { return get<std::int64_t>(value_, "an integer"); }
double Json::as_number() const {
  if (is_integer()) return static_cast<double>(as_integer());
  return get<double>(value_, "a number");
}
const std::string& Json::as_string() const { return get<std::string>(value_, "a string"); }
const Json::Array& Json::as_array() const { return get<Array>(value_, "an array"); }
const Json::Object& Json::as_object() const { return get<Object>(value_, "an object"); }

Json& Json::operator[](const std::string& key) {
  if (is_null()) value_ = Object{};
  if (Object* object = std::get_if<Object>(&value_)) return (*object)[key];
  throw std::runtime_error("not an object");
}

const Json* Json::find(const std::string& key) const {
  const Object* object = std::get_if<Object>(&value_);
  if (object == nullptr) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &found->second;
}

void Json::push_back(Json v) {
  if (is_null()) value_ = Array{};
  if (Array* array = std::get_if<Array>(&value_)) {
    array->push_back(std::move(v));
    return;
  }
  throw std::runtime_error("not an array");
}

std::string Json::dump(int indent) const {
  std::string out;
  append(out, *this, indent, 0);
  return out;
}

}  // namespace phos
