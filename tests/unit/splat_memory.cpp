// What pictures take of memory.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/memory.h"
#include "splat/picture/memory.h"

namespace phos::test {
namespace {

RenderOptions picture(std::int64_t side, const char* layers) {
  RenderOptions options;
  options.width = options.height = side;
  options.layers = {layers};
  return options;
}

}  // namespace

TEST(PictureMemory, GrowsWithPixelsAndLayers) {
  const double small = picture_bytes(picture(100, "all"));
  EXPECT_DOUBLE_EQ(picture_bytes(picture(200, "all")), 4 * small);
  EXPECT_LT(picture_bytes(picture(100, "beauty")), 0.6 * small);
}

TEST(PictureMemory, IsSaidBeforeItIsTaken) {
  EXPECT_EQ(require_memory(picture(100, "all")), "");
  const auto free = static_cast<double>(free_memory_bytes());
  ASSERT_GT(free, 0);
  const double of_pixel = picture_bytes(picture(1, "all"));
  const auto side = static_cast<std::int64_t>(std::sqrt(4 * free / of_pixel));
  try {
    require_memory(picture(side, "all"));
    FAIL() << "there is no such memory";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_memory);
    EXPECT_NE(std::string(error.what()).find(text(side, " x ", side)), std::string::npos) << error.what();
  }
}

TEST(PictureMemory, InTextOfThreeDigits) {
  EXPECT_EQ(memory_text(512 * 1048576.0), "512 MiB");
  EXPECT_EQ(memory_text(23.44 * 1073741824.0), "23.4 GiB");
}

}  // namespace phos::test
