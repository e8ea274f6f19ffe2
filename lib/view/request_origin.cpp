#include "view/request_origin.h"

#include <algorithm>

namespace phos::inline view {
namespace {

bool all_of_set(std::string_view s, std::string_view set) {
  return !s.empty() && s.find_first_not_of(set) == std::string_view::npos;
}

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// Four numbers of up to three digits.
bool is_ipv4(std::string_view s) {
  int parts = 0;
  for (std::size_t at = 0; at <= s.size(); ++parts) {
    const std::size_t end = std::min(s.find('.', at), s.size());
    const std::string_view part = s.substr(at, end - at);
    if (part.size() > 3 || !all_of_set(part, "0123456789")) return false;
    at = end + 1;
  }
  return parts == 4;
}

/// Hexadecimal numbers and colons.
bool is_ipv6(std::string_view s) {
  return s.find(':') != std::string_view::npos && all_of_set(s, "0123456789abcdefABCDEF:.");
}

bool is_port(std::string_view s) { return s.size() <= 5 && all_of_set(s, "0123456789"); }

}  // namespace

bool names_this_server(std::string_view host_header, std::string_view served_host) {
  std::string_view name = host_header, rest;
  const bool bracketed = name.starts_with('[');
  const std::size_t end = bracketed ? name.find(']') : name.find(':');
  if (bracketed && end == std::string_view::npos) return false;
  if (end != std::string_view::npos) {
    rest = name.substr(bracketed ? end + 1 : end);
    name = bracketed ? name.substr(1, end - 1) : name.substr(0, end);
  }
  if (!rest.empty() && !(rest.starts_with(':') && is_port(rest.substr(1)))) return false;
  if (bracketed) return is_ipv6(name);
  return is_ipv4(name) || same_letters(name, "localhost") ||
         (!name.empty() && same_letters(name, served_host));
}

bool is_same_origin(std::optional<std::string_view> origin_header, std::string_view host_header) {
  constexpr std::string_view kScheme = "http://";
  if (!origin_header) return true;
  return origin_header->starts_with(kScheme) &&
         same_letters(origin_header->substr(kScheme.size()), host_header);
}

}  // namespace phos::inline view
