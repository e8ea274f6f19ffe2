#include "radiance/store.h"

#include "core/options.h"

namespace phos::inline radiance {

void declare_options(Options& options, Store& store) {
  options.choice<Store>(
      "store", store, {{"float", Store::floats}, {"compact", Store::compact}},
      "type of the numbers in the file: float: 32 bits each; compact: a third of the size, with light as "
      "half floats (11 bits, of any size) and gradients as bytes with one exponent for each band of a record",
      Recorded::unless_default);
}

}  // namespace phos::inline radiance
