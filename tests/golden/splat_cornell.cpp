// A picture of the Cornell box: what it says of itself, exactly, and every channel within tolerance.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

class Picture : public GoldenCornell {
 protected:
  static void make(const std::string& splatter) {
    make_irradiance();
    if (!std::filesystem::exists(path(splatter)))
      must({"splat", scene(), path("irradiance"), "--width", "32", "--pixel-samples", "2", "--light-samples",
            "4", "--splat", splatter, "-o", path(splatter)});
  }
};

TEST_F(Picture, SaysWhatItIs) {
  make("cpu");
  const Image image = read_image(path("cpu"));
  std::string said = std::to_string(image.width()) + " x " + std::to_string(image.height()) + "\n";
  for (const char* name : {"format", "tool", "algorithm", "command", "parameters", "counters"}) {
    const auto found = image.attributes.find(std::string("phos.") + name);
    said.append(name)
        .append(" ")
        .append(found == image.attributes.end() ? "(none)" : found->second)
        .append("\n");
  }
  for (const auto& [channel, values] : image.channels()) said.append("channel ").append(channel).append("\n");
  expect_golden_text("splat-cornell.txt", said);
}

// Where the processor's rounding takes a photon into a record's hull or leaves it out, the light there
// changes by some thousandths.
TEST_F(Picture, LooksAsItDid) {
  make("cpu");
  expect_golden_image("splat-cornell.exr", path("cpu"), {.relative = 1e-3, .fraction = 0.2, .hard = 0.5});
  expect_golden_image("splat-cornell.exr", path("cpu"), {.relative = 0.03, .fraction = 0.01, .hard = 0.5});
}

/// OpenGL draws the same but for pixels on edges, which it may give to another surface.
TEST_F(Picture, LooksTheSameThroughOpenGl) {
  if (updating_golden()) GTEST_SKIP() << "the picture of the CPU is the golden one";
  make("gl");
  Image image = read_image(path("gl"));
  const Image golden = read_image(golden_path("splat-cornell.exr"));
  for (const char* channel : {"R", "G", "B", "indirect.G", "illuminance.Y", "weight.Y", "position.X"}) {
    const ChannelDifference d = difference(image.channel(channel), golden.channel(channel), 0.03);
    EXPECT_LE(d.beyond, 0.03) << channel;
  }
}

}  // namespace
}  // namespace phos::test
