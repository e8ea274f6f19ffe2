// Keys of a study's own sections, taken one by one.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "study/spec/toml.h"

namespace phos::inline study {

/// A section whose keys are taken by name; finish() refuses those that nobody took. All throw Error(usage)
/// naming line and key.
class StudyKeys {
 public:
  /// A section that is absent has no key. One that is no table is refused.
  StudyKeys(const TomlFile& file, std::string section);
  /// The value, null if it is absent.
  const Json* take(const std::string& key);
  std::optional<std::string> word(const std::string& key);
  std::optional<std::int64_t> integer(const std::string& key, std::int64_t least);
  std::optional<double> number(const std::string& key);
  std::optional<bool> flag(const std::string& key);
  /// One word or a list of some; empty where it is absent.
  std::vector<std::string> words(const std::string& key);
  std::vector<std::int64_t> integers(const std::string& key, std::int64_t least);
  /// Keys that nobody took.
  std::vector<std::string> rest() const;
  /// `known`: the names that an unknown key may be meant for.
  void finish(std::vector<std::string> known = {}) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const;
  std::size_t line(const std::string& key) const;
  std::string where(const std::string& key) const { return file_.where(section_ + "." + key); }

 private:
  const TomlFile& file_;
  std::string section_;
  const Json* table_;
  std::set<std::string> taken_;
};

}  // namespace phos::inline study
