#include "scene/gltf/uri.h"

#include <cstdint>
#include <filesystem>

#include "core/error.h"
#include "file/atomic_file.h"

namespace phos::inline scene {
namespace {

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

std::string decode_percent(const std::string& s) {
  std::string out;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const int high = s[i] == '%' && i + 2 < s.size() ? hex_digit(s[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(s[i + 2]) : -1;
    if (low < 0) {
      out += s[i];
      continue;
    }
    out += static_cast<char>(16 * high + low);
    i += 2;
  }
  return out;
}

}  // namespace

bool is_data_uri(const std::string& uri) { return uri.rfind("data:", 0) == 0; }

std::optional<std::string> decode_data_uri(const std::string& uri) {
  constexpr const char* kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  if (mark == std::string::npos) return std::nullopt;
  std::string out;
  out.reserve((uri.size() - mark) / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = mark + std::string(kMark).size(); i < uri.size() && uri[i] != '='; ++i) {
    const int digit = base64_digit(uri[i]);
    if (digit < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out += static_cast<char>(bits >> held & 0xff);
  }
  return out;
}

std::string read_referred(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(ExitCode::bad_input, path, "is named by a scene, but is not a file; put a file there");
  return read_text(path);
}

std::string beside(const std::string& scene_path, const std::string& name) {
  return (std::filesystem::path(scene_path).parent_path() / name).string();
}

std::optional<std::string> uri_file(const std::string& scene_path, const std::string& uri) {
  const std::string name = decode_percent(uri);
  if (name.empty() || name.find('\0') != std::string::npos) return std::nullopt;
  if (name.find(':') != std::string::npos || std::filesystem::path(name).is_absolute()) return std::nullopt;
  return beside(scene_path, name);
}

std::optional<std::string> file_below(const std::string& scene_path, const std::string& uri) {
  const std::filesystem::path normal = std::filesystem::path(decode_percent(uri)).lexically_normal();
  if (!normal.empty() && *normal.begin() == "..") return std::nullopt;
  return uri_file(scene_path, uri);
}

}  // namespace phos::inline scene
