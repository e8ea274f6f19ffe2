// A picture is encoded whole or not at all where memory runs out: OpenEXR leaves out lines that it cannot
// compress, and says nothing. A program of its own: OpenEXR's threads would not outlive the fork into a child
// with less memory.
#include <random>

#include "image/exr/encode.h"
#include "support/little_memory.h"
#include "support/run.h"

namespace phos {
namespace {

TEST(LittleMemory, ExrIsEncodedWholeOrNotAtAll) {
  Image image(600, 400);
  std::mt19937 random(5);
  for (const char* name : {"R", "G", "B"})
    for (float& v : image.channel(name)) v = static_cast<float>(random());
  const auto in_a_child = [&] {
    const std::string path = test::scratch("image_memory") + "/whole.exr";
    test::in_little_memory(std::uint64_t{1} << 32, [&] {
      test::spill(path, encode_exr(image, ExrCompression::zip));
      return 0;
    });
    return test::slurp(path);
  };
  constexpr std::uint64_t kTimes = 16;  // each thread wants an arena of its own
  test::expect_whole_or_no_memory<std::string>(
      in_a_child(), [&] { return encode_exr(image, ExrCompression::zip); }, kTimes);
}

}  // namespace
}  // namespace phos
