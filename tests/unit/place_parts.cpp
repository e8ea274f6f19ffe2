// Parts of a run of records at given places: joined, they are the file of the whole run.
#include "place/parts.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/estimators.h"
#include "support/run.h"
#include "support/scenes.h"

namespace phos {
namespace {

class Parts : public ::testing::Test {
 protected:
  Parts() : scene_(test::furnace(0.5f).scene), rays_(scene_), estimator_(rays_) {
    options_.resolve(scene_.bounds.diagonal_m() / 4);
    folder_ = test::scratch("cache_parts");
    for (std::size_t i = 0; i < 200; ++i) {
      RandomStream random(3, Stage::test, i);
      points_.push_back({{2 * random.uniform(), 0, 1.5f * random.uniform()}, {0, 1, 0}});
    }
  }

  IrradianceCache empty() const {
    IrradianceCache cache;
    cache.accuracy = options_.accuracy, cache.scene_hash = scene_.hash;
    return cache;
  }
  /// A header as a tool makes it, with an event that came before the records.
  Provenance header(const std::string& variant = "",
                    const std::string& command = "phos-test --seed 0") const {
    Provenance p;
    p.tool = "phos-test 1", p.command = command, p.scene_hash = scene_.hash;
    p.inputs["scene"] = "1234";
    p.key = variant.empty() ? "abcd" : "abcd:part " + variant;
    p.counters.add("coarse records", 17);
    return p;
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name + ".irradiance"; }

  std::string whole() const {
    IrradianceCache cache = empty();
    Provenance p = header();
    place_every(cache, estimator_, rays_, options_, points_, p.counters);
    write_irradiance(path("whole"), cache, p);
    return test::slurp(path("whole"));
  }
  std::string part(const std::string& name, const std::string& command = "phos-test --seed 0") const {
    std::string file = path(name + command.substr(command.size() - 1));
    std::replace(file.begin() + static_cast<std::ptrdiff_t>(folder_.size()) + 1, file.end(), '/', '-');
    write_part(file, make_part(empty(), estimator_, rays_, options_, name, points_), header(name, command));
    return file;
  }
  std::string merged(const std::vector<std::string>& parts) const {
    const MergedParts all = read_parts(parts);
    EXPECT_EQ(all.provenance.key, key_of_merged_parts(parts));
    write_irradiance(path("merged"), all.cache, all.provenance);
    return test::slurp(path("merged"));
  }
  void expect_refused(const std::vector<std::string>& parts, ExitCode code, const std::string& says) const {
    try {
      read_parts(parts);
      FAIL() << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code) << e.what();
      EXPECT_NE(text(e.where(), ": ", e.what()).find(says), std::string::npos) << e.what();
    }
  }

  Scene scene_;
  RayScene rays_;
  test::DistanceEstimator estimator_;
  RecordOptions options_;
  std::vector<SurfaceSample> points_;
  std::string folder_;
};

TEST_F(Parts, AnyNumberInAnyOrderIsTheWholeByteForByte) {
  const std::string all = whole();
  for (const int n : {1, 2, 3, 7}) {
    std::vector<std::string> parts;
    for (int k = 1; k <= n; ++k) parts.push_back(part(text(k, '/', n)));
    EXPECT_EQ(merged(parts), all) << n;
    std::rotate(parts.begin(), parts.begin() + n / 2, parts.end());
    std::swap(parts.front(), parts.back());
    EXPECT_EQ(merged(parts), all) << n;
  }
}

TEST_F(Parts, MoreThanThereArePoints) {
  points_.resize(2);
  const std::string all = whole();
  EXPECT_EQ(merged({part("3/4"), part("1/4"), part("4/4"), part("2/4")}), all);
  points_.clear();
  EXPECT_EQ(merged({part("2/2"), part("1/2")}), whole());
}

TEST_F(Parts, NeighboursOfOtherPartsHaveTheirSay) {
  // The whole run clamps radii; a part by itself does not.
  IrradianceCache cache = empty();
  Counters counters;
  const PlacementReport report = place_every(cache, estimator_, rays_, options_, points_, counters);
  EXPECT_GT(report.clamped_to_neighbour, 0u);
  const IrradiancePart one = make_part(empty(), estimator_, rays_, options_, "1/1", points_);
  std::size_t clamped = 0;
  for (std::size_t i = 0; i < one.made.size(); ++i)
    clamped += one.made[i].record.radius_m > cache.records[i].radius_m;
  EXPECT_GT(clamped, 0u);
}

TEST_F(Parts, APartIsNoCache) {
  const Container file = Container::open(part("1/2"));
  try {
    read_irradiance(file);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("part 1/2 of a run"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("phos-merge"), std::string::npos) << e.what();
  }
}

TEST_F(Parts, WhatDoesNotBelongTogether) {
  const std::string a = part("1/2"), b = part("2/2");
  expect_refused({a}, ExitCode::mismatch, "missing part 2/2");
  expect_refused({a, a, b}, ExitCode::mismatch, "and so is");
  expect_refused({a, part("2/2", "phos-test --seed 1")}, ExitCode::mismatch, "another run");
  expect_refused({a, part("2/3")}, ExitCode::mismatch, "another run");
  whole();
  expect_refused({a, path("whole")}, ExitCode::bad_input, "is a whole cache already");
  points_.pop_back();
  expect_refused({a, part("2/2")}, ExitCode::mismatch, "another run");
  IrradianceCache cache = empty();
  cache.records.resize(1);
  EXPECT_THROW(make_part(cache, estimator_, rays_, options_, "1/2", points_), Error);
}

TEST_F(Parts, DamagedHeaders) {
  const std::string a = part("1/1");
  const Container file = Container::open(a);
  const auto rewrite = [&](const std::function<void(Json&)>& change) {
    Provenance p = file.provenance();
    change(p.extra["run"]);
    ContainerWriter writer;
    for (const auto& [name, tensor] : file.tensors())
      writer.add<float>(name, file.values<float>(name, tensor.shape), tensor.shape, tensor.unit);
    writer.write(path("damaged"), p);
    return path("damaged");
  };
  EXPECT_EQ(merged({rewrite([](Json&) {})}), whole());
  for (const char* name :
       {"first", "total", "min_radius_m", "max_radius_m", "scene_lo_m", "scene_hi_m", "counters"}) {
    expect_refused({rewrite([&](Json& run) { run[name] = Json(); })}, ExitCode::bad_input, name);
    expect_refused({rewrite([&](Json& run) { run[name] = "x"; })}, ExitCode::bad_input, name);
  }
  expect_refused({rewrite([](Json& run) { run["first"] = 3; })}, ExitCode::mismatch, "starts at record 3");
  expect_refused({rewrite([](Json& run) { run["total"] = 300; })}, ExitCode::mismatch, "200 of 300");
  expect_refused({rewrite([](Json& run) { run["min_radius_m"] = -1; })}, ExitCode::bad_input, "min_radius_m");
  expect_refused({rewrite([](Json& run) { run["max_radius_m"] = 1e-9; })}, ExitCode::bad_input,
                 "min_radius_m");
  expect_refused({rewrite([](Json& run) {
                   run["scene_lo_m"] = Json::Array{1, 2};
                 })},
                 ExitCode::bad_input, "scene_lo_m");
  std::string bytes = test::slurp(a);
  bytes[bytes.size() - 50] ^= 8;
  test::spill(path("flipped"), bytes);
  expect_refused({path("flipped")}, ExitCode::bad_input, "damaged");
}

}  // namespace
}  // namespace phos
