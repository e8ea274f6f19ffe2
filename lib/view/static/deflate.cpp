// The one source of the module that includes libdeflate.
#include "view/static/deflate.h"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "core/error.h"

namespace phos::inline view {
namespace {

/// Levels above take several times as long for 1 % less.
constexpr int kLevel = 9;

struct FreeDeflate {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

}  // namespace

std::string deflated(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, FreeDeflate> compressor(libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::string smaller(libdeflate_deflate_compress_bound(compressor.get(), bytes.size()), '\0');
  const std::size_t size = libdeflate_deflate_compress(compressor.get(), bytes.data(), bytes.size(),
                                                       smaller.data(), smaller.size());
  PHOS_CHECK(size > 0, bytes.size(), " bytes");  // the bound holds any result
  smaller.resize(size);
  return smaller;
}

}  // namespace phos::inline view
