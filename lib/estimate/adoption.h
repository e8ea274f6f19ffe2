// Options that an earlier run recorded, for a run that adds to its file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/options.h"
#include "file/container.h"

namespace phos::inline estimate {

/// Values of a choice by name.
template <class E>
using Names = std::vector<std::pair<std::string, E>>;

template <class E>
const std::string& name_in(const Names<E>& names, E value) {
  for (const auto& [name, e] : names) {
    if (e == value) return name;
  }
  PHOS_CHECK(false, "value ", static_cast<int>(value));
}

/// Takes over what an earlier run recorded, option by option. One that it did not record stays as it is; one
/// that was given and differs throws Error(mismatch) saying which.
class Adoption {
 public:
  Adoption(const Options& given, const Container& earlier) : given_(given), earlier_(earlier) {}

  void number(const char* name, double& value) const { value = settle(name, value, &Json::as_number); }
  void number(const char* name, std::optional<double>& value) const {
    if (find(name)) value = settle(name, value.value_or(0), &Json::as_number);
  }
  void integer(const char* name, std::int64_t& value) const {
    value = settle(name, value, &Json::as_integer);
  }
  /// `other_name`: of another option that sets the same value; may be null.
  template <class E>
  void choice(const char* name, E& value, const Names<E>& names, const char* other_name = nullptr) const {
    const Json* was = find(name);
    if (was && was->is_string()) settle_choice(name, value, names, was->as_string(), other_name);
  }
  /// Of an option that is recorded only where it is not `unless` (Recorded::unless_default).
  template <class E>
  void choice_unless(E unless, const char* name, E& value, const Names<E>& names) const {
    const Json* was = find(name);
    settle_choice(name, value, names, was && was->is_string() ? was->as_string() : name_in(names, unless),
                  nullptr);
  }
  void number_unless(double unless, const char* name, double& value) const {
    const Json* was = find(name);
    const double earlier = was && was->is_number() ? was->as_number() : unless;
    if (given_.given(name) && value != earlier) disagree(name, Json(earlier).dump(), Json(value).dump());
    value = earlier;
  }

 private:
  const Json* find(const std::string& name) const {
    const Json* was = earlier_.provenance().parameters.find(name);
    return was && !was->is_null() ? was : nullptr;
  }
  template <class E>
  void settle_choice(const char* name, E& value, const Names<E>& names, const std::string& was,
                     const char* other_name) const {
    const bool given = given_.given(name) || (other_name && given_.given(other_name));
    if (given && was != name_in(names, value)) disagree(name, was, name_in(names, value));
    for (const auto& [text, e] : names) {
      if (was == text) value = e;
    }
  }
  template <class T>
  T settle(const char* name, T value, T (Json::*as)() const) const {
    const Json* was = find(name);
    if (!was || !was->is_number()) return value;
    const T earlier = (was->*as)();
    if (given_.given(name) && value != earlier) disagree(name, was->dump(), Json(value).dump());
    return earlier;
  }
  [[noreturn]] void disagree(const std::string& name, const std::string& was, const std::string& now) const {
    throw Error(ExitCode::mismatch, earlier_.path(),
                text("was made with --", name, " ", was, ", not ", now, "; leave --", name,
                     " out to add with the same, or make a new file without --add-to"));
  }
  const Options& given_;
  const Container& earlier_;
};

}  // namespace phos::inline estimate
