// Messages between phos-view and its page: what is written is read again, and damage is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "core/json.h"
#include "core/random.h"
#include "support/complaint.h"
#include "view/message/reader.h"
#include "view/message/writer.h"

namespace phos {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::string a_question() {
  MessageWriter writer(MessageKind::question);
  writer.add("ray", "number", std::vector<std::uint32_t>{7});
  writer.add("ray", "set", std::vector<std::uint32_t>{1});
  writer.add("ray", "origin", std::vector<Vec3>{{1, 2, 3}});
  writer.add("ray", "direction", std::vector<Vec3>{{0, -1, 0.5f}});
  writer.add("group", "weight", std::vector<float>{1, 0.5f});
  return writer.message();
}

/// A scene of one triangle without texture coordinates.
std::string a_scene(std::uint32_t last_corner = 2) {
  MessageWriter writer(MessageKind::scene);
  writer.add("vertex", "position", std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  writer.add("vertex", "normal", std::vector<Vec3>(3, {0, 0, 1}));
  writer.add("triangle", "corner", std::vector<std::uint32_t>{0, 1, last_corner});
  writer.add("camera_name", "utf8", std::vector<std::uint8_t>{'e', 'y', 'e'});
  return writer.message();
}

std::string refusal(const std::string& bytes, MessageKind kind) {
  return test::complaint_of([&] { MessageReader(bytes, kind); });
}

/// The message with other bytes from `at` on.
template <class T>
std::string with(std::string bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

TEST(ViewMessage, RoundTrip) {
  const std::string bytes = a_question();
  const MessageReader read(bytes, MessageKind::question);
  EXPECT_EQ(read.rows("ray"), 1u);
  EXPECT_EQ(read.numbers("ray", "number"), std::vector<std::uint32_t>{7});
  EXPECT_EQ(read.floats("ray", "origin"), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(read.floats("ray", "direction"), (std::vector<float>{0, -1, 0.5f}));
  EXPECT_EQ(read.floats("group", "weight"), (std::vector<float>{1, 0.5f}));

  const std::string of_scene = a_scene();
  const MessageReader scene(of_scene, MessageKind::scene);
  EXPECT_EQ(scene.rows("vertex"), 3u);
  EXPECT_TRUE(scene.floats("vertex", "uv").empty());
  EXPECT_EQ(scene.rows("material"), 0u);
  EXPECT_EQ(scene.bytes("camera_name", "utf8"), "eye");
}

TEST(ViewMessage, BytesAreAsTheFormatSays) {
  const std::string bytes = a_question();
  // Header; number and set: rows, 4 bytes, padding; origin and direction: rows, 12 bytes, padding; weights:
  // rows, 8 bytes.
  ASSERT_EQ(bytes.size(), 16u + 16 + 16 + 24 + 24 + 16);
  EXPECT_EQ(bytes.substr(0, 16), std::string("phov\2\0\3\0\x70\0\0\0\0\0\0\0", 16));
  EXPECT_EQ(bytes.substr(16, 16), std::string("\1\0\0\0\0\0\0\0\7\0\0\0\0\0\0\0", 16));
}

TEST(ViewMessage, EveryLengthButTheWholeIsRefused) {
  for (const auto& [bytes, kind] :
       {std::pair(a_question(), MessageKind::question), {a_scene(), MessageKind::scene}}) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      std::string part = bytes.substr(0, size);
      EXPECT_NE(refusal(part, kind), "") << size;
      if (size >= kMessageHeaderBytes) part = with(part, 8, std::uint64_t{size});  // as if it were whole
      EXPECT_NE(refusal(part, kind), "") << size;
    }
    const std::string longer = with(bytes + std::string(8, '\0'), 8, std::uint64_t{bytes.size() + 8});
    EXPECT_NE(refusal(longer, kind).find("after its last field"), std::string::npos);
  }
}

TEST(ViewMessage, DamageIsNamed) {
  const std::string bytes = a_question();
  const auto says = [](const std::string& damaged, const char* words) {
    const std::string said = refusal(damaged, MessageKind::question);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  says(with(bytes, 0, 'P'), "phov");
  says(with(bytes, 4, std::uint16_t{1}), "version 1");
  says(with(bytes, 6, std::uint16_t{4}), "kind 4");
  says(with(bytes, 6, std::uint16_t{999}), "kind 999");
  says(with(bytes, 16, std::uint64_t{2}), "1 rows of ray.set, and the table has 2");
  for (const std::uint64_t rows : {std::uint64_t{1} << 32, ~std::uint64_t{0}, std::uint64_t{1} << 62})
    says(with(bytes, 16, rows), "cut off within ray.number");
  says(with(bytes, 28, '\1'), "no zeros");
  says(with(bytes, 56, std::numeric_limits<float>::infinity()), "ray.origin");
  says(with(bytes, 56, kUnknown), "not finite");
  EXPECT_NE(refusal(a_scene(3), MessageKind::scene).find("refers to row 3 of vertex"), std::string::npos);
  EXPECT_EQ(refusal(a_scene(kNoRow), MessageKind::scene), "");
}

TEST(ViewMessage, ANumberMayBeUnknownWhereTheFormatSaysSo) {
  for (const bool unknown : {true, false}) {
    MessageWriter writer(MessageKind::reading);
    for (const MessageField& field : layout_of(MessageKind::reading).fields) {
      const bool nan = unknown ? field.may_be_unknown : field.name == "illuminance";
      if (field.type == FieldType::u32)
        writer.add(field.table, field.name, std::vector<std::uint32_t>(field.components));
      else
        writer.add(field.table, field.name, std::vector<float>(field.components, nan ? kUnknown : 1.f));
    }
    EXPECT_EQ(refusal(writer.message(), MessageKind::reading) == "", unknown);
  }
}

/// Bytes changed at random are refused or give values; sanitizers and the reader's own checks see the rest.
TEST(ViewMessage, RandomDamage) {
  const std::string bytes = a_scene();
  int refused = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    RandomStream random(1, Stage::test, i);
    std::string damaged = bytes;
    for (int k = 0; k < 1 + static_cast<int>(i % 3); ++k) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<float>(bytes.size()));
      damaged[std::min(at, bytes.size() - 1)] = static_cast<char>(random.uniform() * 256.f);
    }
    refused += refusal(damaged, MessageKind::scene) != "";
  }
  EXPECT_GT(refused, 10000);
}

TEST(ViewMessage, FieldsAreNamedOnceAndReferToTables) {
  for (const MessageLayout& layout : message_layouts()) {
    std::set<std::pair<std::string_view, std::string_view>> names;
    std::set<std::string_view> tables;
    for (const MessageField& field : layout.fields) {
      EXPECT_TRUE(names.emplace(field.table, field.name).second) << field.table << "." << field.name;
      EXPECT_GT(field.components, 0u);
      EXPECT_TRUE(field.refers_to.empty() || field.type == FieldType::u32) << field.name;
      tables.insert(field.table);
    }
    for (const MessageField& field : layout.fields)
      EXPECT_TRUE(field.refers_to.empty() || tables.contains(field.refers_to)) << field.refers_to;
  }
  EXPECT_NE(message_format_json().find("\"name\":\"irradiance\""), std::string::npos);
}

}  // namespace
}  // namespace phos
