#include "core/random.h"

#include <Random123/philox.h>

#include "core/error.h"

namespace phos {

void RandomStream::refill() {
  PHOS_CHECK(bounce_ <= 0xffff, "bounce ", bounce_);
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(item_), static_cast<std::uint32_t>(item_ >> 32),
       bounce_ << 16 | (block_ & 0xffff), static_cast<std::uint32_t>(stage_) | (block_ & ~0xffffu)}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
  const r123::Philox4x32::ctr_type result = r123::Philox4x32()(counter, key);
  for (std::size_t i = 0; i < 4; ++i) buffer_[i] = result[i];
  ++block_;
  used_ = 0;
}

}  // namespace phos
