// Films of any size and strength, and files of them that are damaged.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "support/complaint.h"
#include "support/films.h"
#include "temporal/film/file.h"

namespace phos {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A chain of two records on a triangle that turns and grows by a third, in a scene of this size and light.
struct Chain {
  Chain(float size, float power) : later(size * 1.3f) {
    const glm::quat turn = glm::angleAxis(1.f, glm::normalize(Vec3(1, 2, 3)));
    first = test::one_triangle(size);
    second = test::one_triangle(later, turn, size * Vec3(4, 5, 6));
    const IrradianceCache random = test::random_cache(2);
    for (int i = 0; i < 2; ++i) {
      FilmRecord& r = film.records.emplace_back();
      r.record = random.records[static_cast<std::size_t>(i)];
      r.record.position *= size, r.record.radius_m *= size, r.record.distance_m *= size;
      r.record.irradiance *= power, r.record.stderr_lx *= power;
      for (int c = 0; c < 3; ++c)
        r.record.rotation_gradient[c] *= power, r.record.translation_gradient[c] *= power / size;
      r.life.birth = 10 + 5 * i, r.life.end = 15 + 5 * i;
      r.life.anchor = {0, 0.2f, 0.3f};
      r.life.turn = pose_of(i == 0 ? first : second, r.life.anchor)->turn;
    }
    film.info = test::film_info(TemporalGradients::interpolated);
    film.records[0].change = change_between(film.records[0], film.records[1]);
  }
  float later;
  Scene first, second;
  Film film;
};

/// A millionth and a million times the size, a millionth of a millionth of the light and as much more.
TEST(Film, ScenesOfAnySizeAndLight) {
  const Chain one(1, 1);
  for (const auto& [size, power] :
       {std::pair(1e-6f, 1.f), std::pair(1e6f, 1.f), std::pair(1.f, 1e-12f), std::pair(1.f, 1e12f),
        std::pair(1e-6f, 1e12f), std::pair(1e6f, 1e-12f)}) {
    const Chain other(size, power);
    for (std::int64_t frame = 10; frame < 20; ++frame) {
      const IrradianceRecord expected = cache_at(one.film, frame, one.second).records.at(0);
      const IrradianceRecord r = cache_at(other.film, frame, other.second).records.at(0);
      const auto expect_near = [&](const Vec3& a, const Vec3& b, float unit) {
        EXPECT_LT(glm::length(a / unit - b), 2e-6f * std::max(1.f, glm::length(b)))
            << size << " " << power << " " << frame;
      };
      expect_near(r.position, expected.position, size);
      expect_near(r.normal, expected.normal, 1);
      expect_near(r.irradiance, expected.irradiance, power);
      for (int c = 0; c < 3; ++c) {
        expect_near(r.rotation_gradient[c], expected.rotation_gradient[c], power);
        expect_near(r.translation_gradient[c], expected.translation_gradient[c], power / size);
      }
      EXPECT_NEAR(r.radius_m / size, expected.radius_m, 2e-6f * expected.radius_m);
      EXPECT_EQ(r.weight, expected.weight);
    }
  }
}

/// A film of two thousand million frames.
TEST(Film, VeryLongLives) {
  Film film;
  film.info.frames = {0, 2'000'000'000};
  film.info.gradients = TemporalGradients::interpolated;
  FilmRecord r;
  r.record.irradiance = Rgb(1), r.record.radius_m = 1;
  r.life.birth = 0, r.life.end = 2'000'000'001;
  r.change.irradiance = Rgb(5e-10f), r.change.radius_m = -4e-10f;
  film.records.push_back(r);
  for (const std::int64_t frame : {0, 1, 1'000'000'000, 2'000'000'000}) {
    const IrradianceRecord now = cache_at(film, frame, {}).records.at(0);
    EXPECT_NEAR(now.irradiance.x, 1 + 5e-10 * static_cast<double>(frame), 1e-5);
    EXPECT_GT(now.radius_m, 0);
  }
  EXPECT_TRUE(cache_at(film, 2'000'000'001, {}).records.empty());
}

// --- damaged files ---

class DamagedFilm : public ::testing::TestWithParam<const char*> {
 protected:
  struct Column {
    Dtype dtype;
    Shape shape;
    std::vector<std::byte> bytes;
    template <class T>
    T& at(std::size_t i) {
      return reinterpret_cast<T*>(bytes.data())[i];
    }
    std::size_t rows() const { return static_cast<std::size_t>(shape[0]); }
  };
  using Columns = std::map<std::string, Column>;

  DamagedFilm() {
    std::filesystem::create_directories(folder_);
    const std::string path = folder_ + "/good";
    if (radiance())
      write_film(path, test::random_radiance_film({3, 2, 3, 3, 1, 3}, true, TemporalGradients::interpolated),
                 test::radiance_provenance());
    else
      write_film(path, test::random_film(6, true, TemporalGradients::interpolated),
                 test::irradiance_provenance());
    std::ifstream in(path, std::ios::binary);
    good_ = std::string(std::istreambuf_iterator<char>(in), {});
    const Container file = Container::open(path);
    provenance_ = file.provenance();
    for (const auto& [name, tensor] : file.tensors())
      columns_[name] = {tensor.dtype, tensor.shape, {tensor.bytes.begin(), tensor.bytes.end()}};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  bool radiance() const { return std::strcmp(GetParam(), "radiance") == 0; }

  std::string read(const std::string& path) const {
    return test::complaint_of([&] {
      const Container file = Container::open(path);
      radiance() ? void(read_radiance_film(file)) : void(read_film(file));
    });
  }
  /// Written with proper checksums after `damage`; the complaint of the reader, "" if it took the file.
  std::string complaint(const std::function<void(Columns&, Json& film)>& damage) const {
    Columns columns = columns_;
    Provenance provenance = provenance_;
    damage(columns, provenance.extra["film"]);
    ContainerWriter writer;
    for (const auto& [name, c] : columns) {
      const auto as = [&]<class T>(T) {
        writer.add<T>(name, {reinterpret_cast<const T*>(c.bytes.data()), c.bytes.size() / sizeof(T)}, c.shape,
                      "1");
      };
      if (c.dtype == Dtype::f32) as(float());
      if (c.dtype == Dtype::i32) as(std::int32_t());
      if (c.dtype == Dtype::u32) as(std::uint32_t());
      if (c.dtype == Dtype::u8) as(std::uint8_t());
    }
    const std::string path = folder_ + "/bad";
    writer.write(path, provenance);
    return read(path);
  }
  /// Of one changed number.
  template <class T>
  std::string with(const char* column, std::size_t i, T value) const {
    return complaint([&](Columns& c, Json&) { c.at(column).at<T>(i) = value; });
  }
  std::string with_header(const char* name, const Json& value) const {
    return complaint([&](Columns&, Json& film) { film[name] = value; });
  }

  // In memory where that can be: each of the many files is flushed to the disk otherwise.
  std::string folder_ = std::filesystem::exists("/dev/shm") ? text("/dev/shm/phos-film-", getpid())
                                                            : test::scratch("damaged-film");
  std::string good_;
  Provenance provenance_;
  Columns columns_;
};

#define EXPECT_NAMED(said, what) EXPECT_NE((said).find(what), std::string::npos) << (said)

TEST_P(DamagedFilm, TheGoodOneIsTaken) {
  EXPECT_EQ(complaint([](Columns&, Json&) {}), "");
  EXPECT_EQ(read(folder_ + "/good"), "");
}

TEST_P(DamagedFilm, EveryTruncationIsNoticed) {
  const std::string path = folder_ + "/short";
  for (std::size_t size = 0; size < good_.size(); size += 1 + good_.size() / 200) {
    std::ofstream(path, std::ios::binary) << good_.substr(0, size);
    EXPECT_NE(read(path), "") << size;
  }
}

TEST_P(DamagedFilm, ChangedBytesAreNoticed) {
  const std::string path = folder_ + "/changed";
  for (std::size_t i = 0; i < good_.size(); i += 1 + good_.size() / 200) {
    std::string bytes = good_;
    bytes[i] = static_cast<char>(bytes[i] ^ 16);
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_NE(read(path), "") << i;
  }
}

TEST_P(DamagedFilm, ColumnsThatLackOrDiffer) {
  for (const auto& [name, column] : columns_) {
    if (name == "order") continue;  // without it all are of one order
    EXPECT_NE(complaint([&, &n = name](Columns& c, Json&) { c.erase(n); }), "") << name;
    EXPECT_NE(complaint([&, &n = name](Columns& c, Json&) {
                Column& of = c.at(n);
                of.bytes.resize(of.bytes.size() / of.rows() * (of.rows() - 1));
                --of.shape[0];
              }),
              "")
        << name;
  }
}

TEST_P(DamagedFilm, LivesThatCannotBe) {
  // Frames 10 to 29; chains 0 and 2, each with lives 10-13, 13-18 and 21-26.
  EXPECT_NAMED(with<std::int32_t>("end", 1, 13), "record 1");
  EXPECT_NAMED(with<std::int32_t>("end", 1, -5), "not after its birth");
  EXPECT_NAMED(with<std::int32_t>("birth", 0, 9), "record 0 has a life outside of the film");
  EXPECT_NAMED(with<std::int32_t>("end", 5, 31), "outside");
  EXPECT_EQ(with<std::int32_t>("end", 5, 30), "");
  EXPECT_NAMED(with<std::int32_t>("end", 0, 14), "record 1 has a life that begins before");
  EXPECT_NAMED(with<std::int32_t>("birth", 1, INT32_MIN), "outside");
  EXPECT_NAMED(with<std::int32_t>("end", 1, INT32_MAX), "outside");
  EXPECT_NAMED(with<std::uint32_t>("chain", 2, 9), "record 3 has a chain before");
  EXPECT_NAMED(with<std::uint32_t>("chain", 3, 0), "record 3 has a life that begins before");
  EXPECT_NAMED(with("rate", 4, -1.f), "row 4 of tensor \"rate\"");
  EXPECT_NAMED(with("rate", 4, kInfinity), "row 4 of tensor \"rate\"");
}

TEST_P(DamagedFilm, AnchorsThatCannotBe) {
  // Record 3 is not anchored; of others all must be as it should.
  EXPECT_NAMED(with("anchor_uv", 2, 1.5f), "record 1 has an anchor outside its triangle");
  EXPECT_NAMED(with("anchor_uv", 3, -0.1f), "record 1");
  EXPECT_NAMED(with("anchor_uv", 3, kNan), "row 1 of tensor \"anchor_uv\"");
  EXPECT_NAMED(complaint([](Columns& c, Json&) {
                 c.at("anchor_uv").at<float>(2) = 0.6f, c.at("anchor_uv").at<float>(3) = 0.6f;
               }),
               "record 1");
  EXPECT_NAMED(with("anchor_turn", 4, 2.f), "row 1 of tensor \"anchor_turn\"");
  EXPECT_NAMED(with("anchor_turn", 4, kNan), "row 1 of tensor \"anchor_turn\"");
  EXPECT_EQ(with("anchor_uv", 6, 7.f), "") << "not anchored";
  EXPECT_EQ(with<std::uint32_t>("anchor", 1, 1u << 31), "") << "no such triangle: at no frame is it there";
}

TEST_P(DamagedFilm, NumbersThatAreNone) {
  for (const auto& [name, column] : columns_) {
    if (column.dtype != Dtype::f32 || name.starts_with("anchor")) continue;
    const std::size_t numbers = column.bytes.size() / sizeof(float), row = numbers / column.rows();
    for (std::size_t i = 0; i < numbers; i += 1 + numbers / 20) {
      const std::string said = with(name.c_str(), i, kNan);
      EXPECT_NAMED(said, text("row ", i / row, " of tensor \"", name, "\" is not "));
    }
  }
  // Finite now, but not at the end of its life.
  EXPECT_NAMED(with("radius_change", 1, std::numeric_limits<float>::max()), "record 1 has a change");
}

TEST_P(DamagedFilm, HeadersThatLie) {
  const auto frames = [](const Json& first, const Json& last) { return Json(Json::Array{first, last}); };
  for (const Json& bad :
       {frames(10, 28), frames(9, 29), frames(29, 10), frames(-1, 18), frames(10, "29"),
        frames(10, std::int64_t{1} << 60), frames(10.5, 29), Json(Json::Array{10}), Json("10:29"), Json()})
    EXPECT_NE(with_header("frames", bad), "") << bad.dump();
  for (const Json& bad : {Json(0), Json(-0.1), Json("a"), Json()})
    EXPECT_NE(with_header("temporal_accuracy", bad), "") << bad.dump();
  for (const Json& bad : {Json(0), Json(-1), Json(1.5), Json()}) EXPECT_NE(with_header("max_life", bad), "");
  for (const Json& bad : {Json(-1), Json("a"), Json()}) EXPECT_NE(with_header("fade", bad), "");
  for (const Json& bad : {Json("linear"), Json(1), Json()}) EXPECT_NE(with_header("gradients", bad), "");
  for (const Json& bad : {Json(Json::Array{}), Json(Json::Array{"a"}), Json("a"), Json()})
    EXPECT_NE(with_header("scene_hash", bad), "");
  EXPECT_NE(complaint([](Columns&, Json& film) { film = "film"; }), "");
  EXPECT_NE(complaint([](Columns&, Json& film) { film = Json::Array{1}; }), "");
}

/// Any numbers in the columns of a film's own: refused, or sound at every frame.
TEST_P(DamagedFilm, NoiseIsRefusedOrHarmless) {
  int taken = 0;
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    RandomStream random(12, Stage::test, trial);
    const std::string said = complaint([&](Columns& c, Json&) {
      const char* names[] = {"birth",  "end",       "chain",       "rate",
                             "anchor", "anchor_uv", "anchor_turn", "radius_change"};
      Column& column = c.at(names[static_cast<std::size_t>(8 * random.uniform())]);
      const auto i = static_cast<std::size_t>(static_cast<float>(column.bytes.size() / 4) * random.uniform());
      const auto small = static_cast<std::int32_t>(40 * random.uniform()) - 5;
      column.at<std::int32_t>(i) =
          random.uniform() < 0.5f ? small : static_cast<std::int32_t>(4e9 * random.uniform() - 2e9);
    });
    if (!said.empty()) continue;
    ++taken;
    const Container file = Container::open(folder_ + "/bad");
    const Scene scene = test::one_triangle();
    for (std::int64_t frame = 10; frame < 30; ++frame) {
      if (radiance()) {
        for (const RadianceRecord& r : cache_at(read_radiance_film(file), frame, scene).records)
          EXPECT_TRUE(is_finite(r) && r.radius_m > 0 && r.weight > 0 && r.weight <= 1);
      } else {
        for (const IrradianceRecord& r : cache_at(read_film(file), frame, scene).records)
          EXPECT_TRUE(is_finite(r.irradiance) && is_finite(r.normal) && std::isfinite(r.radius_m) &&
                      r.radius_m > 0 && r.weight > 0 && r.weight <= 1);
      }
    }
  }
  EXPECT_GT(taken, 20);
  EXPECT_LT(taken, 280);
}

INSTANTIATE_TEST_SUITE_P(Of, DamagedFilm, ::testing::Values("irradiance", "radiance"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace phos
