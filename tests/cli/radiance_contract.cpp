// phos-radiance at the command line: what it makes, says and refuses, and what it leaves behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/error.h"
#include "core/json.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos::test {
namespace {

std::string scene() { return data("cornell-glossy22.glb"); }

/// A folder with photons and lobes of the Cornell box whose back wall is glossy, made once.
const std::string& folder() {
  static const std::string path = [] {
    const std::string f = scratch("radiance-cli");
    EXPECT_EQ(run_tool({"photons", scene(), "--photons", "20000", "-o", f + "/c.photons"}).code, 0);
    EXPECT_EQ(run_tool({"brdf", scene(), "-o", f + "/c.brdf"}).code, 0);
    return f;
  }();
  return path;
}
std::string photons() { return folder() + "/c.photons"; }
std::string brdf() { return folder() + "/c.brdf"; }

Run radiance(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "radiance");
  return run_tool(arguments);
}
/// With few rays and large radii: fast.
Run quick(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--rays", "64", "--min-radius", "0.1"});
  return radiance(arguments);
}

void expect_failure(const Run& run, int code, const std::string& word) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_EQ(run.err.rfind("phos-radiance: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty());
}

std::size_t records_in(const std::string& path) { return Container::open(path).vectors("position").size(); }
Json stats() { return parse_json(slurp(folder() + "/stats.json"), "stats"); }

TEST(Radiance, HelpVersionAndNoArguments) {
  const test::Run help = radiance({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* said :
       {"--accuracy", "--gloss", "--rays", "--add-to", "--gather-bounces", "--raster-side", "--gl"})
    EXPECT_NE(help.out.find(said), std::string::npos) << said;
  // Nothing is offered that would do nothing.
  for (const char* not_said : {"--paths", "--kernel", "--light-samples", "--part"})
    EXPECT_EQ(help.out.find(not_said), std::string::npos) << not_said;
  EXPECT_EQ(radiance({"--version"}).code, 0);
  expect_failure(radiance({}), 2, "SCENE");
}

TEST(Radiance, OnTheGlossyWallAloneSameBytesForAnyThreads) {
  std::string bytes;
  for (const char* threads : {"1", "2", "5"}) {
    const std::string out = folder() + "/" + threads + ".radiance";
    // Inputs in any order.
    const test::Run run = *threads == '1'
                              ? quick({scene(), photons(), brdf(), "-o", out, "--threads", threads})
                              : quick({brdf(), photons(), scene(), "-o", out, "--threads", threads});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(run.out.empty());
    if (bytes.empty()) bytes = slurp(out);
    EXPECT_EQ(slurp(out), bytes) << threads;
  }
  const Container file = Container::open(folder() + "/1.radiance", FileKind::radiance);
  file.verify();
  const std::size_t n = records_in(file.path());
  EXPECT_GT(n, 20u);
  for (const Vec3& p : file.vectors("position")) EXPECT_NEAR(p.z, 0.5592f, 1e-3f);
  const Provenance& p = file.provenance();
  const std::int64_t order = p.extra.find("order")->as_integer();
  EXPECT_EQ(order, 10) << "Phong 22 at 1 % of the energy";
  EXPECT_FALSE(file.has("order")) << "all are equal";
  const auto numbers = static_cast<std::uint64_t>(order * order);
  EXPECT_NO_THROW(file.values<Half>("coefficients", {n, 3, numbers}));
  EXPECT_NO_THROW(file.values<std::int8_t>("gradient_x", {n, 3, numbers}));
  for (const char* input : {"scene", "photons", "brdf"}) EXPECT_TRUE(p.inputs.contains(input)) << input;
  EXPECT_EQ(p.history.as_array().size(), 2u);
  EXPECT_TRUE(p.parameters.find("max-radius")->is_number());
  EXPECT_EQ(run_tool({"info", file.path(), "--verify"}).code, 0);
  EXPECT_NE(run_tool({"info", file.path()}).out.find("coefficients"), std::string::npos);
}

TEST(Radiance, ReportsOrdersErrorsAndTime) {
  const test::Run run = quick(
      {scene(), photons(), brdf(), "-o", folder() + "/stats.radiance", "--stats", folder() + "/stats.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("back-glossy: records of order 10"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(" of order 10;"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("mean standard error"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("projected here"), std::string::npos) << run.err;
  const Json json = stats();
  const auto records = json.find("records")->as_integer();
  EXPECT_EQ(static_cast<std::size_t>(records), records_in(folder() + "/stats.radiance"));
  EXPECT_GE(json.find("records_made")->as_integer(), records);
  EXPECT_GT(json.find("ms_per_record")->as_number(), 0);
  EXPECT_GT(json.find("relative_error")->as_number(), 0.01);
  ASSERT_EQ(json.find("runs")->as_array().size(), 1u);
  EXPECT_EQ(json.find("runs")->as_array()[0].find("order")->as_integer(), 10);
  EXPECT_EQ(json.find("gloss")->as_array()[0].find("material")->as_string(), "back-glossy");
}

/// Materials of two orders: the file says which record has which.
TEST(Radiance, RecordsHaveTheBandsThatTheirMaterialWants) {
  const std::string out = folder() + "/lobes.radiance";
  const test::Run run = quick({data("lobes.gltf"), "--gather-bounces", "1", "--place", "surface", "-o", out});
  ASSERT_EQ(run.code, 0) << run.err;
  const Container file = Container::open(out, FileKind::radiance);
  const std::size_t n = records_in(out);
  const auto order = file.values<std::uint8_t>("order", {n});
  const auto position = file.vectors("position");
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(order[i], position[i].x < 1.25f ? 5 : 10);
  EXPECT_GT(std::ranges::count(order, 5), 5);
  EXPECT_GT(std::ranges::count(order, 10), 5);
  EXPECT_NE(run.err.find(text(std::ranges::count(order, 5), " of order 5, ", std::ranges::count(order, 10),
                              " of order 10")),
            std::string::npos)
      << run.err;
  EXPECT_EQ(run_tool({"info", out, "--verify"}).code, 0);
  EXPECT_EQ(run_tool({"info", out, "--dump", "order"}).out.rfind("order\n", 0), 0u);
}

/// Lobes made on the fly are those of the file.
TEST(Radiance, WithoutLobesTheyAreMadeHere) {
  const std::string with = folder() + "/with.radiance", without = folder() + "/without.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "-o", with}).code, 0);
  const test::Run run = quick({scene(), photons(), "-o", without});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("projected here"), std::string::npos) << run.err;
  const Container a = Container::open(with), b = Container::open(without);
  for (const auto& [name, tensor] : a.tensors())
    EXPECT_TRUE(std::ranges::equal(tensor.bytes, b.tensors().at(name).bytes)) << name;
}

TEST(Radiance, NothingGlossyOrAllOfItTraced) {
  const std::string out = folder() + "/none.radiance";
  test::Run run = radiance({data("cornell-measured.glb"), "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the scene has no gloss"), std::string::npos) << run.err;
  EXPECT_EQ(records_in(out), 0u);
  run = radiance({scene(), photons(), "--gloss", "traced", "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("all gloss is traced"), std::string::npos) << run.err;
  EXPECT_EQ(records_in(out), 0u);
  EXPECT_EQ(run_tool({"info", out, "--verify"}).code, 0);
}

TEST(Radiance, ReuseDoesNothingTwice) {
  const std::string out = folder() + "/reuse.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "-o", out}).code, 0);
  const auto before = std::filesystem::last_write_time(out);
  const test::Run again = quick({scene(), photons(), brdf(), "-o", out, "--reuse"});
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(out), before);
  ASSERT_EQ(quick({scene(), photons(), brdf(), "-o", out, "--reuse", "--accuracy", "0.4"}).code, 0);
  EXPECT_NE(std::filesystem::last_write_time(out), before);
}

/// What one camera needs, then what another lacks of it: records that are there stay as they are.
TEST(Radiance, AddsToAFileThatKeepsItsRecords) {
  const std::string first = folder() + "/first.radiance", both = folder() + "/both.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "--place", "view", "--width", "40", "--accuracy", "0.25", "-o",
                   first})
                .code,
            0);
  const test::Run run = quick({scene(), photons(), brdf(), "--place", "view", "--camera", "left-view",
                               "--width", "40", "--add-to", first, "-o", both});
  ASSERT_EQ(run.code, 0) << run.err;
  const Container a = Container::open(first), b = Container::open(both);
  const std::size_t n = records_in(first);
  EXPECT_GT(records_in(both), n);
  EXPECT_EQ(b.provenance().extra.find("accuracy")->as_number(), 0.25) << "taken over";
  for (const char* column : {"position", "coefficients", "gradient_x", "radius"}) {
    const auto was = a.tensors().at(column).bytes, is = b.tensors().at(column).bytes;
    ASSERT_GT(is.size(), was.size());
    EXPECT_TRUE(std::ranges::equal(was, is.subspan(0, was.size()))) << column;
  }
  // Of what is covered, nothing is added.
  ASSERT_EQ(quick({scene(), photons(), brdf(), "--place", "view", "--camera", "left-view", "--width", "40",
                   "--add-to", both, "-o", both})
                .code,
            0);
  EXPECT_EQ(records_in(both), b.vectors("position").size());
}

TEST(Radiance, PointsOnOtherSurfacesAreNotForIt) {
  const std::string csv = folder() + "/points.csv", out = folder() + "/at.radiance";
  spill(csv, "x,y,z,nx,ny,nz\n0.2,0.3,0.5592,0,0,-1\n0.3,0,0.3,0,1,0\n0.2,0.3,0.3,0,0,-1\n");
  ASSERT_EQ(quick({scene(), photons(), brdf(), "--at", csv, "-o", out}).code, 0);
  ASSERT_EQ(records_in(out), 1u);
  EXPECT_NEAR(Container::open(out).vectors("position")[0].z, 0.5592f, 1e-6f);
}

TEST(Radiance, AddingWithOtherOptionsIsRefused) {
  const std::string first = folder() + "/other.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "-o", first}).code, 0);
  const std::string before = slurp(first);
  const auto add = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {scene(), photons(), "--add-to", first, "-o", first});
    return radiance(more);
  };
  expect_failure(add({brdf(), "--accuracy", "0.1"}), 4, "--accuracy");
  expect_failure(add({brdf(), "--gradients", "none"}), 4, "--gradients");
  expect_failure(add({brdf(), "--estimate", "hull"}), 4, "--estimate");
  const std::string sharper = folder() + "/sharper.brdf";
  ASSERT_EQ(
      run_tool({"brdf", scene(), "--error", "0.02", "--max-order", "14", "--resolution", "8", "-o", sharper})
          .code,
      0);
  const test::Run orders = add({sharper, "--quiet"});
  expect_failure(orders, 4, "order 10");
  const std::string others = folder() + "/others.photons";
  ASSERT_EQ(run_tool({"photons", scene(), "--photons", "1000", "--seed", "5", "-o", others}).code, 0);
  expect_failure(radiance({scene(), others, brdf(), "--quiet", "--add-to", first, "-o", first}), 4,
                 "other photons");
  EXPECT_EQ(slurp(first), before);
}

TEST(Radiance, BadInputs) {
  const std::string out = folder() + "/bad.radiance";
  const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& word) {
    arguments.insert(arguments.end(), {"--quiet", "-o", out});
    expect_failure(radiance(arguments), code, word);
  };
  refused({scene(), folder() + "/missing.photons"}, 3, "missing.photons");
  refused({folder() + "/missing.glb", photons()}, 3, "missing.glb");
  refused({scene(), scene()}, 2, "second scene");
  refused({scene(), brdf(), brdf()}, 2, "second file of lobes");
  refused({photons(), brdf()}, 2, "no scene");
  refused({scene(), brdf()}, 2, "earlier cache");  // what would light the places that rays find?
  refused({scene(), brdf(), "--estimate", "hull"}, 2, "photons");
  refused({data("spheres.glb"), photons()}, 4, "another scene");
  refused({data("spheres.glb"), brdf()}, 4, "another scene");
  refused({scene(), photons(), brdf(), "--gather-bounces", "0"}, 2, "gather-bounces");
  refused({scene(), photons(), brdf(), "--accuracy", "0"}, 2, "accuracy");
  refused({scene(), photons(), brdf(), "--rays", "1"}, 2, "rays");
  refused({scene(), photons(), brdf(), "--error", "0.1"}, 2, "error");
  refused({scene(), photons(), brdf(), "--place", "given"}, 2, "--at");
  refused({scene(), photons(), brdf(), "--place", "view", "--camera", "nobody"}, 2, "nobody");
  expect_failure(radiance({scene(), photons(), "--quiet", "-o", folder() + "/no/where.radiance"}), 3,
                 "where.radiance");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Radiance, TruncatedInputsAreRefused) {
  const std::string part = folder() + "/part.file", out = folder() + "/part.radiance",
                    made = folder() + "/whole.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "-o", made}).code, 0);
  for (const std::string& file : {brdf(), made}) {
    const std::string whole = slurp(file);
    for (const std::size_t size : {std::size_t{9}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
      spill(part, whole.substr(0, size));
      const test::Run run = file == made
                                ? radiance({scene(), photons(), "--quiet", "--add-to", part, "-o", out})
                                : radiance({scene(), photons(), part, "--quiet", "-o", out});
      EXPECT_TRUE(run.code == 3 || run.code == 2) << size << ": " << run.err;
      EXPECT_TRUE(is_one_line(run.err)) << run.err;
      EXPECT_FALSE(std::filesystem::exists(out));
    }
  }
}

/// Lamps alone, from no photons: one bounce, by rays; and photons alone, without rays.
TEST(Radiance, FirstBounceAndPhotons) {
  const std::string out = folder() + "/way.radiance";
  test::Run run = quick({scene(), brdf(), "--gather-bounces", "1", "-o", out});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_GT(records_in(out), 20u);
  run = radiance({scene(), photons(), brdf(), "--estimate", "hull", "-o", out});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_GT(records_in(out), 20u);
}

/// The same records in a third of the bytes; more are added to either, and a file that is there is known.
TEST(Radiance, StoresShortNumbersUnlessFloatsAreAskedFor) {
  const std::string longer = folder() + "/float.radiance", shorter = folder() + "/compact.radiance";
  const std::vector<std::string> same{scene(), photons(), brdf(), "--place", "view", "--width", "48"};
  const auto made = [&](std::vector<std::string> more) {
    std::vector<std::string> words = same;
    words.insert(words.end(), more.begin(), more.end());
    const test::Run run = quick(words);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  };
  made({"--store", "float", "-o", longer});
  made({"-o", shorter});
  ASSERT_GT(records_in(longer), 20u);
  EXPECT_EQ(records_in(longer), records_in(shorter));
  EXPECT_LT(2.5 * static_cast<double>(std::filesystem::file_size(shorter)),
            static_cast<double>(std::filesystem::file_size(longer)));
  for (const std::string& path : {longer, shorter})
    EXPECT_EQ(run_tool({"info", path, "--verify"}).code, 0) << path;
  EXPECT_NE(made({"--reuse", "-o", shorter}).find("up to date"), std::string::npos);
  EXPECT_EQ(made({"--reuse", "--store", "compact", "-o", longer}).find("up to date"), std::string::npos);
  EXPECT_EQ(slurp(longer), slurp(shorter));
  EXPECT_EQ(
      radiance({scene(), photons(), brdf(), "--place", "surface", "--add-to", shorter, "-o", shorter}).code,
      0);
  EXPECT_GE(records_in(shorter), records_in(longer));
}

TEST(Radiance, WithoutGradients) {
  const std::string out = folder() + "/flat.radiance";
  ASSERT_EQ(quick({scene(), photons(), brdf(), "--gradients", "none", "-o", out}).code, 0);
  EXPECT_FALSE(Container::open(out).has("gradient_x"));
}

TEST(Radiance, InterruptedItLeavesWhatWasThere) {
  const std::string out = folder() + "/kept.radiance";
  spill(out, "earlier");
  const test::Run run = run_and_interrupt(
      {"radiance", scene(), photons(), brdf(), "--rays", "100000", "--accuracy", "0.02", "-o", out},
      std::chrono::milliseconds(1000));
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_EQ(slurp(out), "earlier");
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    EXPECT_EQ(entry.path().filename().string().find("kept.radiance."), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace phos::test
