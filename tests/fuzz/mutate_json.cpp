#include "mutate_json.h"

#include <cmath>
#include <vector>

namespace phos::fuzz {
namespace {

void list_all(const Json& v, std::vector<const Json*>& all) {
  all.push_back(&v);
  if (v.is_array())
    for (const Json& item : v.as_array()) list_all(item, all);
  if (v.is_object())
    for (const auto& [name, item] : v.as_object()) list_all(item, all);
}

const std::vector<Json>& unusual() {
  static const std::vector<Json> all{Json(),
                                     Json(true),
                                     Json(0),
                                     Json(-1),
                                     Json(1),
                                     Json(2),
                                     Json(255),
                                     Json(65536),
                                     Json(2147483647),
                                     Json(-2147483647 - 1),
                                     Json(4294967295),
                                     Json(4294967296),
                                     Json(INT64_MAX),
                                     Json(INT64_MIN),
                                     Json(0.5),
                                     Json(-0.0),
                                     Json(1e-320),
                                     Json(1e38),
                                     Json(1e300),
                                     Json(-1e300),
                                     Json(1e-7),
                                     Json(""),
                                     Json("x"),
                                     Json(Json::Array{}),
                                     Json(Json::Object{}),
                                     Json(9007199254740993),
                                     Json(16777217),
                                     Json(3.5)};
  return all;
}

Json near(const Json& v, Choice& choice) {
  if (v.is_bool()) return !v.as_bool();
  if (v.is_integer()) {
    const auto n = static_cast<std::uint64_t>(v.as_integer());  // wraps
    const std::uint64_t changed[] = {n + 1, n - 1, 2 * n,
                                     n / 2, 0 - n, n ^ (std::uint64_t{1} << choice.below(63))};
    return static_cast<std::int64_t>(choice.of(changed));
  }
  if (v.is_number()) {
    const double x = v.as_number(),
                 changed[] = {-x, 2 * x, x / 2, x * 1e30, x * 1e-30, std::nextafter(x, 1e9)};
    return choice.of(changed);
  }
  if (v.is_string()) {
    std::string s = v.as_string();
    if (s.empty() || choice.once_in(3)) return s + static_cast<char>('!' + choice.below(90));
    const std::size_t at = choice.below(s.size());
    if (choice.once_in(2)) return s.erase(at, 1 + choice.below(4));
    s[at] = static_cast<char>('!' + choice.below(90));
    return s;
  }
  return choice.of(unusual());
}

Json changed(const Json& v, const std::vector<const Json*>& all, Choice& choice) {
  if (choice.once_in(4)) return choice.of(unusual());
  if (choice.once_in(4)) return *choice.of(all);
  if (v.is_array() && !v.as_array().empty()) {
    Json::Array list = v.as_array();
    const auto at = static_cast<std::ptrdiff_t>(choice.below(list.size()));
    const Json item = list[static_cast<std::size_t>(at)];
    if (choice.once_in(2)) {
      list.erase(list.begin() + at);
    } else {
      list.insert(list.begin() + at, 1 + choice.below(choice.once_in(4) ? 100 : 2), item);
    }
    return list;
  }
  if (v.is_object() && !v.as_object().empty()) {
    Json::Object members = v.as_object();
    auto at = members.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(choice.below(members.size())));
    const auto [name, item] = *at;
    if (!choice.once_in(3)) members.erase(at);
    if (!choice.once_in(3))
      members[choice.once_in(2) ? name + "x" : members.empty() ? "x" : members.begin()->first] = item;
    return members;
  }
  return near(v, choice);
}

/// The value number `at`, depth first, is changed.
Json walk(const Json& v, std::size_t& at, const std::vector<const Json*>& all, Choice& choice) {
  if (at-- == 0) return changed(v, all, choice);
  if (v.is_array()) {
    Json::Array list;
    for (const Json& item : v.as_array()) list.push_back(walk(item, at, all, choice));
    return list;
  }
  if (v.is_object()) {
    Json::Object members;
    for (const auto& [name, item] : v.as_object()) members[name] = walk(item, at, all, choice);
    return members;
  }
  return v;
}

}  // namespace

Json mutated(const Json& document, Choice& choice) {
  std::vector<const Json*> all;
  list_all(document, all);
  std::size_t at = choice.below(all.size());
  return walk(document, at, all, choice);
}

}  // namespace phos::fuzz
