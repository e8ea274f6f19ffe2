#include "image/exr/header.h"

#include <ImfCompression.h>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

#include "core/error.h"

namespace phos::inline image {
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

/// Sizes of the values that the library reads whatever size is stated (OpenEXR file layout, "Attribute
/// types").
std::size_t fixed_size(std::string_view type) {
  static const std::map<std::string_view, std::size_t> sizes{{"box2i", 16},
                                                             {"box2f", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33f", 36},
                                                             {"m33d", 72},
                                                             {"m44f", 64},
                                                             {"m44d", 128},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2i", 8},
                                                             {"v2f", 8},
                                                             {"v2d", 16},
                                                             {"v3i", 12},
                                                             {"v3f", 12},
                                                             {"v3d", 24}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// A value must end where its attribute does: the library goes on where it thinks that the value ends.
void walk_value(std::string_view type, Walker value) {
  if (type == "chlist") {
    while (!value.name().empty()) value.take(16);
  } else if (type == "stringvector") {
    while (!value.done()) value.take(value.word());
  } else if (type == "floatvector") {
    while (!value.done()) value.take(4);
  } else if (type == "preview") {
    const std::uint64_t pixels = std::uint64_t{value.word()} * value.word();
    if (pixels > (std::uint64_t{1} << 40)) throw std::runtime_error("the preview is too large");
    value.take(static_cast<std::size_t>(4 * pixels));
  } else if (const std::size_t size = fixed_size(type); size > 0) {
    value.take(size);
  } else {
    return;  // as long as it says
  }
  if (!value.done()) throw std::runtime_error("an attribute is of another size than its type");
}

/// Compressions that later versions of the format have; larger numbers are damage.
constexpr unsigned kLaterCompressions = 32;

void require_known_compression(std::string_view value, const std::string& where) {
  const unsigned number = value.empty() ? 0 : static_cast<unsigned char>(value[0]);
  if (number < Imf::NUM_COMPRESSION_METHODS || number >= kLaterCompressions) return;
  throw Error(ExitCode::bad_input, where,
              text("has compression ", number, " of OpenEXR, which phos does not read; save it with ZIP"));
}

/// Attributes up to an empty name; false if there is none.
bool walk_header(Walker& in, const std::string& where) {
  bool any = false;
  for (;; any = true) {
    if (in.name().empty()) return any;
    const std::string_view type = in.name(), value = in.take(in.word());
    walk_value(type, Walker(value));
    if (type == "compression") require_known_compression(value, where);
  }
}

}  // namespace

void check_exr_header(std::string_view file, const std::string& where) {
  Walker in(file);
  in.word();
  const bool many = (in.word() & kManyParts) != 0;
  while (walk_header(in, where) && many) {
  }
}

}  // namespace phos::inline image
