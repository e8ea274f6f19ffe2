// The types of the numbers in files of radiance records.
#pragma once

namespace phos {
class Options;
}

namespace phos::inline radiance {

/// Measured errors: docs/benchmarks.md, "Sizes of radiance records".
enum class Store {
  floats,   ///< 32 bits a number
  compact,  ///< halves for light and standard errors, bytes for gradients (radiance/compact_columns.h)
};
void declare_options(Options& options, Store& store);

}  // namespace phos::inline radiance
