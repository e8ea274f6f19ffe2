#include "file/dtype.h"

namespace phos::inline file {

std::size_t dtype_size(Dtype d) {
  return with_type_of(d, [](auto number) { return sizeof number; });
}

const char* dtype_name(Dtype d) {
  constexpr const char* kNames[] = {"U8", "U16", "I32", "U32", "I64", "U64", "F32", "F64", "I8", "F16"};
  return kNames[static_cast<std::size_t>(d)];
}

}  // namespace phos::inline file
