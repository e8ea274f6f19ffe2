// The page without a server: the precision that it keeps, and that it asks nobody for anything.
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cmath>
#include <limits>
#include <regex>

#include "core/random.h"
#include "scene/load.h"
#include "support/complaint.h"
#include "support/from_base64.h"
#include "support/run.h"
#include "support/unpacked_message.h"
#include "view/message/reader.h"
#include "view/message/writer.h"
#include "view/page_files.h"
#include "view/scene_message.h"
#include "view/static/coding.h"
#include "view/static/deflate.h"
#include "view/static/packed_message.h"
#include "view/static/static_page.h"

namespace phos {
namespace {

constexpr float kGreatest = std::numeric_limits<float>::max();

/// Of any size from 1e-30 to 1e30, and of either sign.
float any_size(RandomStream& random) {
  const float size = std::pow(10.f, 60 * random.uniform() - 30);
  return random.uniform() < 0.5f ? size : -size;
}

TEST(ViewStatic, RoundedNumbersKeepTheirBits) {
  RandomStream random(1, Stage::test, 0);
  for (unsigned bits = 0; bits <= 23; ++bits)
    for (int i = 0; i < 2000; ++i) {
      const float v = any_size(random), r = rounded_to(v, bits);
      EXPECT_LE(std::fabs(static_cast<double>(r) - static_cast<double>(v)),
                std::exp2(-1. - bits) * std::fabs(static_cast<double>(v)))
          << v << " " << bits;
      EXPECT_EQ(rounded_to(r, bits), r);
    }
  EXPECT_EQ(rounded_to(1.f, 0), 1.f);
  EXPECT_EQ(rounded_to(0.f, 7), 0.f);
  EXPECT_EQ(rounded_to(1.25f, 1), 1.5f);  // halves go away from zero
  EXPECT_EQ(rounded_to(-1.25f, 1), -1.5f);
  for (unsigned bits = 0; bits <= 23; ++bits) {
    EXPECT_TRUE(std::isfinite(rounded_to(kGreatest, bits)));
    EXPECT_TRUE(std::isnan(rounded_to(std::numeric_limits<float>::quiet_NaN(), bits)));
  }
}

TEST(ViewStatic, StepsAreEvenAndReachBothEnds) {
  RandomStream random(1, Stage::test, 1);
  for (const unsigned bits : {1u, 8u, 21u, 24u})
    for (const auto& [lo, hi] :
         {std::pair(-3.f, 5.f), {0.f, 1e-20f}, {-kGreatest, kGreatest}, {1e6f, 1.001e6f}}) {
      const std::uint32_t most = (1u << bits) - 1;
      EXPECT_EQ(step_of(lo, lo, hi, bits), 0u);
      EXPECT_EQ(step_of(hi, lo, hi, bits), most);
      const double from = static_cast<double>(lo), size = static_cast<double>(hi) - from;
      for (int i = 0; i < 500; ++i) {
        const auto v = static_cast<float>(from + size * static_cast<double>(random.uniform()));
        EXPECT_LE(std::fabs(from + size * step_of(v, lo, hi, bits) / most - static_cast<double>(v)),
                  0.5000001 * size / most);
      }
    }
  EXPECT_EQ(step_of(2, 2, 2, 21), 0u);
}

TEST(ViewStatic, CodedFieldsAreFieldsOfNumbers) {
  for (const CodedField& coded : coded_fields()) {
    const auto fields = layout_of(coded.kind).fields;
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const MessageField& f) {
      return f.table == coded.table && f.name == coded.name;
    });
    ASSERT_NE(found, fields.end()) << coded.table << "." << coded.name;
    EXPECT_EQ(found->type, FieldType::f32) << coded.name;
    EXPECT_TRUE(coded.coding.coding != Coding::octahedral || found->components == 3u) << coded.name;
    EXPECT_TRUE(coded.coding.coding != Coding::box || coded.coding.bits <= 24u) << coded.name;
  }
}

/// Random values in every field, the optional ones too if asked.
std::string any_message(MessageKind kind, bool optional, RandomStream& random) {
  MessageWriter message(kind);
  for (const MessageField& field : layout_of(kind).fields) {
    if (field.optional && !optional) continue;
    const std::size_t rows = field.table == "distribution" ? 2 : 37, count = rows * field.components;
    std::vector<float> f;
    std::vector<std::uint32_t> u;
    std::vector<std::uint8_t> b;
    while (f.size() < count) {
      if (coding_of(kind, field).coding != Coding::octahedral) {
        f.push_back(any_size(random));
        continue;
      }
      const Vec3 v = Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f;
      const Vec3 unit = f.size() < 9 ? Vec3(f.empty(), f.size() == 3, f.size() == 6) : normalized_or_zero(v);
      f.insert(f.end(), {unit.x, unit.y, unit.z});
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float share = random.uniform();
      const auto any = static_cast<std::uint32_t>(share * 4294967040.f);
      u.push_back(field.refers_to.empty() ? any : share < 0.1f ? kNoRow : any % 2);
      b.push_back(static_cast<std::uint8_t>(any));
    }
    if (field.type == FieldType::f32) message.add(field.table, field.name, f);
    if (field.type == FieldType::u32) message.add(field.table, field.name, u);
    if (field.type == FieldType::u8) message.add(field.table, field.name, b);
  }
  return message.message();
}

/// Expects what coding_of() promises.
void expect_kept(const MessageField& field, FieldCoding coding, const std::vector<float>& was,
                 const std::vector<float>& is) {
  ASSERT_EQ(was.size(), is.size());
  const std::size_t n = field.components;
  std::vector<double> lo(n, 1e300), hi(n, -1e300);
  for (std::size_t i = 0; i < was.size(); ++i) {
    lo[i % n] = std::min(lo[i % n], static_cast<double>(was[i]));
    hi[i % n] = std::max(hi[i % n], static_cast<double>(was[i]));
  }
  for (std::size_t i = 0; i < was.size(); ++i) {
    const double value = static_cast<double>(was[i]), off = std::fabs(static_cast<double>(is[i]) - value);
    switch (coding.coding) {
      case Coding::rounded:
        EXPECT_LE(off, coding.bits == 23 ? 0 : std::exp2(-1. - coding.bits) * std::fabs(value)) << field.name;
        break;
      case Coding::box: {
        const double half_step = (hi[i % n] - lo[i % n]) / (std::exp2(coding.bits) - 1) / 2;
        EXPECT_LE(off, 1.0001 * half_step + 6e-8 * std::fabs(value)) << field.name;
        break;
      }
      case Coding::octahedral:
        EXPECT_LE(off, i < 9 ? 0 : 1e-4) << field.name;
        break;  // axes exactly
      default:
        ADD_FAILURE() << field.name;
    }
  }
}

TEST(ViewStatic, PackedMessagesKeepWhatTheTableSays) {
  for (const MessageKind kind :
       {MessageKind::scene, MessageKind::records, MessageKind::gloss, MessageKind::question})
    for (const bool optional : {true, false}) {
      RandomStream random(1, Stage::test, 2);
      const std::string message = any_message(kind, optional, random);
      const std::string unpacked = test::Unpacker(packed_message(message)).message();
      ASSERT_EQ(unpacked.size(), message.size());
      const MessageReader was(message, kind), is(unpacked, kind);
      for (const MessageField& field : layout_of(kind).fields) {
        const auto same = [&](const auto& a, const auto& b) { EXPECT_EQ(a, b) << field.name; };
        switch (field.type) {
          case FieldType::u8:
            same(is.bytes(field.table, field.name), was.bytes(field.table, field.name));
            break;
          case FieldType::u32:
            same(is.numbers(field.table, field.name), was.numbers(field.table, field.name));
            break;
          case FieldType::f32:
            expect_kept(field, coding_of(kind, field), was.floats(field.table, field.name),
                        is.floats(field.table, field.name));
        }
      }
    }
}

TEST(ViewStatic, MessagesWithoutRowsArePackedToo) {
  const std::string message = MessageWriter(MessageKind::records).message();
  EXPECT_EQ(test::Unpacker(packed_message(message)).message(), message);
}

TEST(ViewStatic, OnlyWholeMessagesArePacked) {
  const std::string message = MessageWriter(MessageKind::records).message();
  const auto refusal = [](const std::string& bytes) {
    return test::complaint_of([&] { packed_message(bytes); });
  };
  EXPECT_EQ(refusal(message), "");
  EXPECT_NE(refusal("{\"title\":\"room.glb\"}").find("phov"), std::string::npos);
  EXPECT_NE(refusal(message.substr(0, 12)).find("phov"), std::string::npos);
  EXPECT_NE(refusal(message.substr(0, message.size() - 8)).find("bytes"), std::string::npos);
  std::string other = message;
  other[6] = 99;
  EXPECT_NE(refusal(other).find("kind 99"), std::string::npos);
}

std::string inflated(const std::string& bytes, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> d(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string whole(size, '\0');
  EXPECT_EQ(
      libdeflate_deflate_decompress(d.get(), bytes.data(), bytes.size(), whole.data(), whole.size(), nullptr),
      LIBDEFLATE_SUCCESS);
  return whole;
}

TEST(ViewStatic, DeflatedBytesComeBack) {
  RandomStream random(1, Stage::test, 3);
  std::string noise;
  for (int i = 0; i < 100000; ++i) noise += static_cast<char>(random.uniform() * 256);
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(100000, 'a'), noise}) {
    const std::string small = deflated(bytes);
    EXPECT_EQ(inflated(small, bytes.size()), bytes);
    EXPECT_EQ(deflated(bytes), small);
  }
  EXPECT_LT(deflated(std::string(100000, 'a')).size(), 200u);
}

PageFiles some_files(std::string records = MessageWriter(MessageKind::records).message()) {
  Json about = Json::Object{};
  about["title"] = "</script>", about["notes"] = Json::Array{};
  return {MessageWriter(MessageKind::scene).message(), std::move(records), about};
}

TEST(ViewStatic, ThePageHoldsAllThatItNeeds) {
  Json provenance = Json::Object{};
  provenance["inputs"] = "</script><script>";
  const PageFiles files = some_files();
  const std::string page = static_page(files, provenance);
  EXPECT_EQ(static_page(files, provenance), page);
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none';"), std::string::npos);
  for (const char* elsewhere : {"src=", "href=\"/", "http:", "https:", "connect-src", "</script><script>"})
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
  for (const std::string_view path : files.paths()) {
    const bool held = page.find("id=\"" + std::string(path) + "\"") != std::string::npos;
    const bool text =
        path == "/" || path.ends_with(".html") || path.ends_with(".css") || path.ends_with(".js");
    EXPECT_NE(held, text) << path;
  }
  // Every module names others as the map does, and only others that are there.
  const std::regex module("\"page/([a-z_]+\\.js)\": \"data:text/javascript;base64,([^\"]*)\""),
      import("['\"](page/|\\./)([a-z_]+\\.js)['\"]");
  std::map<std::string, std::string> scripts;
  for (std::sregex_iterator m(page.begin(), page.end(), module), end; m != end; ++m)
    scripts[m->str(1)] = test::bytes_from_base64(m->str(2));
  EXPECT_TRUE(scripts.contains("view.js"));
  int imports = 0;
  for (const auto& [name, script] : scripts)
    for (std::sregex_iterator m(script.begin(), script.end(), import), end; m != end; ++m, ++imports) {
      EXPECT_EQ(m->str(1), "page/") << name;
      EXPECT_TRUE(scripts.contains(m->str(2))) << name << " imports " << m->str(2);
    }
  EXPECT_GT(imports, 10);
}

/// Sponza with 40,000 records of random numbers, which compress worse than any real ones.
TEST(ViewStatic, SponzaIsSmall) {
  const std::string model = test::shared("scenes/sponza.glb");
  if (model.empty()) GTEST_SKIP() << "../shared/scenes/sponza.glb is not here";
  constexpr std::size_t kRecords = 40000;
  RandomStream random(1, Stage::test, 4);
  MessageWriter records(MessageKind::records);
  for (const MessageField& field : layout_of(MessageKind::records).fields) {
    if (field.table != "record") continue;
    std::vector<float> values(kRecords * field.components);
    for (float& v : values) v = random.uniform() + 0.01f;
    records.add(field.table, field.name, values);
  }
  Json about = Json::Object{};
  const PageFiles files(scene_message(load_scene(model), 16).bytes, records.message(), about);
  const std::size_t bytes = static_page(files, about).size();
  std::printf("[ FIGURES  ] Sponza, 40000 records: %.1f MB\n", static_cast<double>(bytes) / 1e6);
  EXPECT_LT(bytes, 25000000u);
}

}  // namespace
}  // namespace phos
