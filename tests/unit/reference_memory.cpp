// What pictures by path tracing take of memory.
#include <gtest/gtest.h>

#include "reference/render.h"

#include "reference/render_options.h"

namespace phos::test {

TEST(ReferenceMemory, GrowsWithPixelsAndMethod) {
  ReferenceOptions options;
  options.width = options.height = 100;
  const double small = reference_bytes(options);
  EXPECT_GT(small, 1e4 * sizeof(float) * 30);
  options.width = 200;
  EXPECT_DOUBLE_EQ(reference_bytes(options), 2 * small);
  options.method = ReferenceMethod::bidirectional;
  EXPECT_GT(reference_bytes(options), 2 * small);
}

}  // namespace phos::test
