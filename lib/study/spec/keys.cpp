#include "study/spec/keys.h"

#include "core/error.h"
#include "core/text/append_item.h"
#include "core/text/likeness.h"

namespace phos::inline study {

StudyKeys::StudyKeys(const TomlFile& file, std::string section)
    : file_(file), section_(std::move(section)), table_(file.root.find(section_)) {
  if (table_ && !table_->is_object())
    throw Error(
        ExitCode::usage, file_.where(section_),
        text("\"", section_, "\" stands outside of a section; sections begin with a line [", section_, "]"));
}

void StudyKeys::refuse(const std::string& key, const std::string& why) const {
  throw Error(ExitCode::usage, where(key), text("[", section_, "] ", key, ": ", why));
}

std::size_t StudyKeys::line(const std::string& key) const {
  const auto found = file_.line.find(section_ + "." + key);
  return found == file_.line.end() ? 0 : found->second;
}

const Json* StudyKeys::take(const std::string& key) {
  taken_.insert(key);
  return table_ ? table_->find(key) : nullptr;
}

std::optional<std::string> StudyKeys::word(const std::string& key) {
  const Json* v = take(key);
  if (!v) return std::nullopt;
  if (!v->is_string() || v->as_string().empty()) refuse(key, "is not a word in quotes");
  return v->as_string();
}

std::optional<std::int64_t> StudyKeys::integer(const std::string& key, std::int64_t least) {
  const Json* v = take(key);
  if (!v) return std::nullopt;
  if (!v->is_integer() || v->as_integer() < least)
    refuse(key, text("is not a whole number of at least ", least));
  return v->as_integer();
}

std::optional<double> StudyKeys::number(const std::string& key) {
  const Json* v = take(key);
  if (!v) return std::nullopt;
  if (!v->is_number()) refuse(key, "is not a number");
  return v->as_number();
}

std::optional<bool> StudyKeys::flag(const std::string& key) {
  const Json* v = take(key);
  if (!v) return std::nullopt;
  if (!v->is_bool()) refuse(key, "is not true or false");
  return v->as_bool();
}

namespace {

/// A value alone is a list of one.
std::vector<Json> items_of(const Json& v) { return v.is_array() ? v.as_array() : std::vector<Json>{v}; }

}  // namespace

std::vector<std::string> StudyKeys::words(const std::string& key) {
  const Json* v = take(key);
  if (!v) return {};
  std::vector<std::string> all;
  for (const Json& item : items_of(*v)) {
    if (!item.is_string() || item.as_string().empty()) refuse(key, "is not a list of words in quotes");
    for (const std::string& other : all)
      if (other == item.as_string()) refuse(key, text("\"", other, "\" is there twice; leave one out"));
    all.push_back(item.as_string());
  }
  if (all.empty()) refuse(key, "is empty; fill it or leave it out");
  return all;
}

std::vector<std::int64_t> StudyKeys::integers(const std::string& key, std::int64_t least) {
  const Json* v = take(key);
  if (!v) return {};
  std::vector<std::int64_t> all;
  for (const Json& item : items_of(*v)) {
    if (!item.is_integer() || item.as_integer() < least)
      refuse(key, text("is not a list of whole numbers of at least ", least));
    for (const std::int64_t other : all)
      if (other == item.as_integer()) refuse(key, text(other, " is there twice; leave one out"));
    all.push_back(item.as_integer());
  }
  if (all.empty()) refuse(key, "is empty; fill it or leave it out");
  return all;
}

std::vector<std::string> StudyKeys::rest() const {
  std::vector<std::string> all;
  if (table_)
    for (const auto& [key, value] : table_->as_object())
      if (!taken_.contains(key)) all.push_back(key);
  return all;
}

void StudyKeys::finish(std::vector<std::string> known) const {
  known.insert(known.end(), taken_.begin(), taken_.end());
  for (const std::string& key : rest()) {
    std::string all;
    for (const std::string& name : taken_) append_item(all, name);
    const std::string guess = did_you_mean(key, known);
    refuse(key, "is unknown" + (guess.empty() ? "; there are: " + all : guess));
  }
}

}  // namespace phos::inline study
