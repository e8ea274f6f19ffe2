// Scenes and radiance records as the page gets them.
#include <gtest/gtest.h>

#include <set>

#include "support/gloss_view.h"
#include "support/mirrors.h"
#include "support/quad.h"
#include "view/gloss_message.h"
#include "view/message/reader.h"
#include "view/scene_message.h"

namespace phos {
namespace {

using test::add_quad;

/// Of linear light; codes are row by row.
Texture linear_texture(int width, int height, const std::vector<Texture::Code>& codes) {
  Texture texture;
  texture.width = width, texture.height = height, texture.codes = codes;
  return texture;
}

/// Left half black, right half white.
Texture halves(int side) {
  std::vector<Texture::Code> codes;
  for (int i = 0; i < side * side; ++i) {
    const std::uint8_t v = i % side < side / 2 ? 0 : 255;
    codes.push_back({v, v, v, 255});
  }
  return linear_texture(side, side, codes);
}

/// A quad with each texture.
Scene textured(const std::vector<Texture>& textures) {
  Scene scene;
  for (const Texture& texture : textures) {
    Material m;
    m.base_colour.texture = static_cast<std::int32_t>(scene.texture.size());
    scene.texture.push_back(texture);
    scene.material.push_back(m);
    add_quad(scene, 1, 1, static_cast<float>(scene.texture.size()), true,
             static_cast<std::uint32_t>(scene.material.size() - 1));
  }
  finalize(scene);
  return scene;
}

TEST(ViewScene, TexturesAreSentAsTheyAreOrHalvedUntilTheyFit) {
  const Scene scene = textured({halves(8), halves(2)});
  struct Expected {
    TextureLimits most;
    std::vector<std::uint32_t> width;
    std::size_t reduced;
  };
  for (const auto& [most, width, reduced] : {Expected{{}, {8, 2}, 0},
                                             {{.all = 1000}, {8, 2}, 0},
                                             {{.all = 68}, {8, 2}, 0},
                                             {{.all = 67}, {4, 2}, 1},
                                             {{.all = 8}, {2, 2}, 1},
                                             {{.all = 0}, {1, 1}, 2},
                                             {{.side = 8}, {8, 2}, 0},
                                             {{.side = 7}, {4, 2}, 1},
                                             {{.side = 1}, {1, 1}, 2},
                                             {{.all = 8, .side = 4}, {2, 2}, 1}}) {
    SCOPED_TRACE(testing::Message() << most.all << " texels, " << most.side << " on a side");
    const SceneMessage message = scene_message(scene, 1, most);
    EXPECT_EQ(message.reduced_textures, reduced);
    const MessageReader read(message.bytes, MessageKind::scene);
    EXPECT_EQ(read.numbers("texture", "width"), width);
    EXPECT_EQ(read.numbers("texture", "height"), width);
    const auto first = read.numbers("texture", "first_texel");
    EXPECT_EQ(first[1], width[0] * width[0]);
    const std::string_view texels = read.bytes("texel", "rgba");
    ASSERT_EQ(texels.size(), 4 * (width[0] * width[0] + width[1] * width[1]));
    const auto value = [&](std::size_t texel) { return static_cast<unsigned char>(texels[4 * texel]); };
    EXPECT_EQ(value(0), width[0] == 1 ? 128 : 0);
    EXPECT_EQ(value(width[0] - 1), width[0] == 1 ? 128 : 255);
  }
}

TEST(ViewScene, ReducedTexturesHoldTheMeanLight) {
  // 3 x 1 linear, one texel that stays, and 4 x 2 in sRGB, black and white: half of white is 188.
  Texture one = linear_texture(1, 1, {{9, 8, 7, 6}}), chequered = linear_texture(4, 2, {});
  one.srgb = chequered.srgb = true;
  for (int i = 0; i < 8; ++i) {
    const std::uint8_t v = (i + i / 4) % 2 ? 255 : 0;
    chequered.codes.push_back({v, v, v, v});
  }
  const Scene scene = textured(
      {linear_texture(3, 1, {{0, 30, 60, 255}, {90, 30, 60, 255}, {240, 30, 60, 0}}), one, chequered});
  const SceneMessage message = scene_message(scene, 1, {.side = 2});
  EXPECT_EQ(message.reduced_textures, 2u);
  const MessageReader read(message.bytes, MessageKind::scene);
  EXPECT_EQ(read.numbers("texture", "width"), (std::vector<std::uint32_t>{2, 1, 2}));
  EXPECT_EQ(read.numbers("texture", "height"), (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(read.numbers("texture", "first_texel"), (std::vector<std::uint32_t>{0, 2, 3}));
  const std::string_view bytes = read.bytes("texel", "rgba");
  std::vector<int> codes;
  for (const char c : bytes) codes.push_back(static_cast<unsigned char>(c));
  // The third texel of the first stands alone in its block.
  EXPECT_EQ(codes, (std::vector<int>{45, 30, 60,  255, 240, 30,  60,  0,   9,   8,
                                     7,  6,  188, 188, 188, 128, 188, 188, 188, 128}));
}

/// A floor and a mirror in one instance list, and a pane: shares at normal incidence, and parts by plane.
TEST(ViewScene, MirrorsAndPanesTellTheirShares) {
  Scene scene;
  Material floor, mirror, pane;
  floor.kd = Rgb(0.5f);
  mirror.model = Model::mirror, mirror.ks = Rgb(0.8f, 0.7f, 0.6f);
  pane.model = Model::thin_dielectric, pane.ior = 1.5f;
  scene.material = {floor, mirror, pane};
  add_quad(scene, 2, 2, 0, true, 0);
  add_quad(scene, 1, 1, 3, false, 1);
  add_quad(scene, 1, 1, 1, true, 2);
  test::add_lamp(scene, 0.1f, 0.1f, 2, false, Rgb(100));
  finalize(scene);
  const std::string bytes = scene_message(scene, 4).bytes;
  const MessageReader read(bytes, MessageKind::scene);
  const auto specular = read.numbers("material", "specular");
  EXPECT_EQ(specular[0], kNoRow);
  ASSERT_EQ(read.rows("specular"), 2u);
  const auto reflects = read.floats("specular", "reflects"), passes = read.floats("specular", "passes");
  const auto at_normal = [&](const std::vector<float>& table, std::uint32_t material, unsigned c) {
    return table[kSpecularFloats * specular[material] + kSpecularFloats - 3 + c];
  };
  for (unsigned c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(at_normal(reflects, 1, c), mirror.ks[static_cast<int>(c)]);
    EXPECT_EQ(at_normal(passes, 1, c), 0);
    // A pane of index n without absorption: 2 n / (n^2 + 1).
    EXPECT_NEAR(at_normal(passes, 2, c), 3 / 3.25f, 1e-4f);
    EXPECT_NEAR(at_normal(reflects, 2, c), 0.25f / 3.25f, 1e-4f);
  }
  const auto flags = read.numbers("material", "flags");
  EXPECT_EQ(flags[1] & kClear, 0u);
  EXPECT_EQ(flags[2] & kClear, std::uint32_t{kClear});

  // The planes of the mirror and of the pane.
  const auto of_part = read.numbers("part", "mirror"), material = read.numbers("part", "material");
  const auto plane = read.floats("mirror", "plane"), area = read.floats("mirror", "area");
  std::set<std::uint32_t> planes;
  for (std::size_t i = 0; i < of_part.size(); ++i) {
    EXPECT_EQ(of_part[i] == kNoRow, material[i] != 1 && material[i] != 2) << i;
    if (of_part[i] == kNoRow) continue;
    planes.insert(of_part[i]);
    const float z = material[i] == 1 ? 3 : 1;
    EXPECT_NEAR(plane[4 * of_part[i] + 2] * z + plane[4 * of_part[i] + 3], 0, 1e-5f);
    EXPECT_NEAR(area[of_part[i]], 4, 1e-4f);
  }
  EXPECT_EQ(planes.size(), 2u);
  const auto triangles = read.numbers("part", "triangle_count");
  std::uint32_t sum = 0;
  for (const std::uint32_t n : triangles) sum += n;
  EXPECT_EQ(sum, scene.triangle.size());
}

TEST(ViewScene, GlossHasTheRecordsAndTheirLobes) {
  const test::GlossView view(test::glossy_cornell(), 8, 8);
  const auto records = view.records(5, 0.05f, 0.1f);
  ASSERT_EQ(records.size(), 5u);
  const GlossCache cache = view.cache(records);
  EXPECT_TRUE(has_gloss_records(view.scene, &cache));
  const std::string bytes = gloss_message(view.scene, &cache, 0.25);
  const MessageReader read(bytes, MessageKind::gloss);
  EXPECT_EQ(read.floats("cache", "accuracy"), std::vector<float>{0.25f});
  ASSERT_EQ(read.rows("lobe"), 1u);
  const std::uint32_t material = read.numbers("lobe", "material")[0],
                      order = read.numbers("lobe", "order")[0];
  const BrdfTable& table = *cache.tables().table(material);
  EXPECT_EQ(order, static_cast<std::uint32_t>(table.order));
  EXPECT_EQ(read.rows("lobe_row"), static_cast<std::size_t>(table.resolution));
  ASSERT_EQ(read.rows("record"), 5u);
  ASSERT_EQ(read.rows("number"), 5u * 3 * order * order);
  const auto number = read.floats("number", "value");
  const auto first = read.numbers("record", "first_number");
  const RadianceTree& tree = *cache.tree(table.order);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < order * order; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 3 * (first[i] + 3 * k) + c;
        EXPECT_EQ(number[at], tree[i].light[3 * k + c]);
        EXPECT_EQ(number[at + 3], tree[i].gradient_x[3 * k + c]);
        EXPECT_EQ(number[at + 6], tree[i].gradient_y[3 * k + c]);
      }
  // Without records there is nothing to draw.
  EXPECT_FALSE(has_gloss_records(view.scene, nullptr));
  const std::string none = gloss_message(view.scene, nullptr, 0.25);
  EXPECT_EQ(MessageReader(none, MessageKind::gloss).rows("record"), 0u);
}

}  // namespace
}  // namespace phos
