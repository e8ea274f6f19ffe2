#include "image/exr_header.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace phos {
namespace {

constexpr std::uint32_t kManyParts = 0x1000;  // of the version's flags

class Walker {
 public:
  explicit Walker(std::string_view bytes) : rest_(bytes) {}
  std::uint32_t word() {
    std::uint32_t v = 0;
    const std::string_view bytes = take(4);
    for (std::size_t i = 0; i < 4; ++i) v |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
    return v;
  }
  std::string_view name() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) fail();
    const std::string_view s = take(end);
    take(1);
    return s;
  }
  std::string_view take(std::size_t n) {
    if (n > rest_.size()) fail();
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }
  bool done() const { return rest_.empty(); }

 private:
  [[noreturn]] static void fail() {
    throw std::runtime_error("the header reaches beyond the end of the file");
  }
  std::string_view rest_;
};

/// Attributes up to an empty name; false if there is none.
bool walk_header(Walker& in) {
  bool any = false;
  for (;; any = true) {
    if (in.name().empty()) return any;
    const std::string_view type = in.name();
    Walker value(in.take(in.word()));
    if (type == "stringvector")
      while (!value.done()) value.take(value.word());
    if (type == "preview") {
      const std::uint64_t pixels = std::uint64_t{value.word()} * value.word();
      if (pixels > (std::uint64_t{1} << 40)) throw std::runtime_error("the preview is too large");
      value.take(static_cast<std::size_t>(4 * pixels));
    }
  }
}

}  // namespace

void check_exr_header(std::string_view file) {
  Walker in(file);
  in.word();
  const bool many = (in.word() & kManyParts) != 0;
  while (walk_header(in) && many) {
  }
}

}  // namespace phos
