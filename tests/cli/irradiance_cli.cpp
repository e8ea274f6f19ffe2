#include <gtest/gtest.h>

#include <chrono>

#include "file/container.h"
#include "support/cornell_photons.h"

namespace phos::test {
namespace {

/// A folder with photons of the Cornell box, made once.
const std::string& folder() {
  static const std::string path = folder_with_photons("irradiance-cli", "20000");
  return path;
}
std::string scene() { return data("cornell-measured.glb"); }
std::string photons() { return folder() + "/c.photons"; }

Run irradiance(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"irradiance"});
  return run_tool(arguments);
}

void expect_failure(const Run& run, int code, const std::string& word) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty());
}

std::size_t records_in(const std::string& path) { return Container::open(path).vectors("position").size(); }

TEST(Irradiance, HelpVersionAndNoArguments) {
  const auto help = irradiance({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("--accuracy"), std::string::npos);
  EXPECT_EQ(irradiance({"--version"}).code, 0);
  EXPECT_EQ(irradiance({}).code, 2);
}

TEST(Irradiance, InputsInAnyOrderAnyThreadsSameBytes) {
  const std::string a = folder() + "/a.irradiance", b = folder() + "/b.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), "-o", a, "--threads", "1"}).code, 0);
  const auto second = irradiance({photons(), scene(), "-o", b, "--threads", "2"});
  ASSERT_EQ(second.code, 0) << second.err;
  EXPECT_TRUE(second.out.empty());
  EXPECT_EQ(slurp(a), slurp(b));
  const Container file = Container::open(a, FileKind::irradiance);
  file.verify();
  const Provenance& p = file.provenance();
  EXPECT_TRUE(p.inputs.contains("scene") && p.inputs.contains("photons"));
  EXPECT_TRUE(p.parameters.find("min-radius")->is_number());  // automatic values are recorded as resolved
  EXPECT_EQ(p.extra.find("quantity")->as_string(), "indirect");
  EXPECT_EQ(p.history.as_array().size(), 1u);
  EXPECT_GT(records_in(a), 50u);
  EXPECT_EQ(irradiance({scene(), photons(), "-o", a, "--seed", "1"}).code, 0);
  EXPECT_NE(slurp(a), slurp(b));
}

TEST(Irradiance, ReuseDoesNothingTwice) {
  const std::string out = folder() + "/reuse.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), "-o", out}).code, 0);
  const auto before = std::filesystem::last_write_time(out);
  const auto again = irradiance({scene(), photons(), "-o", out, "--reuse"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(out), before);
  ASSERT_EQ(irradiance({scene(), photons(), "-o", out, "--reuse", "--accuracy", "0.4"}).code, 0);
  EXPECT_NE(std::filesystem::last_write_time(out), before);
}

/// Two rings of rays, the least that plans ask for.
TEST(Irradiance, TwelveRaysAreTheLeast) {
  const std::string out = folder() + "/few.irradiance";
  const auto with_rays = [&](const char* rays) {
    return irradiance({scene(), photons(), "--estimate", "gather", "--rays", rays, "-o", out});
  };
  expect_failure(with_rays("11"), 2, "--rays");
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto run = with_rays("12");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_GT(records_in(out), 50u);
}

TEST(Irradiance, PointsAreAddedToAFileThatKeepsItsRecords) {
  const std::string first = folder() + "/first.irradiance", csv = folder() + "/p.csv";
  ASSERT_EQ(
      irradiance({scene(), photons(), "--max-candidates", "50", "--accuracy", "0.15", "-o", first}).code, 0);
  const std::vector<Vec3> was = [&] {
    const Container file = Container::open(first);
    const auto v = file.vectors("irradiance");
    return std::vector<Vec3>(v.begin(), v.end());
  }();
  std::string rows = "x,y,z,nx,ny,nz\n";
  const Container map = Container::open(photons());
  const auto places = map.vectors("position");
  const auto normals = map.values<std::uint32_t>("normal", {places.size()});
  for (std::size_t i = 0; i < places.size(); i += 100) {
    const Vec3 p = places[i], n = decode_octahedral(normals[i]);
    std::ostringstream row;
    row.precision(9);
    row << p.x << ',' << p.y << ',' << p.z << ',' << n.x << ',' << n.y << ',' << n.z << '\n';
    rows += row.str();
  }
  spill(csv, rows);
  // The output may be the file that is added to.
  const auto added =
      irradiance({scene(), photons(), "--at", csv, "--add-to", first, "-o", first, "--passes", "20"});
  ASSERT_EQ(added.code, 0) << added.err;
  const Container file = Container::open(first);
  EXPECT_GT(records_in(first), was.size());
  for (std::size_t i = 0; i < was.size(); ++i) EXPECT_EQ(file.vectors("irradiance")[i], was[i]);
  EXPECT_EQ(file.provenance().extra.find("accuracy")->as_number(), 0.15);  // taken over
  EXPECT_GE(file.provenance().history.as_array().size(), 2u);
  const std::size_t filled = records_in(first);
  ASSERT_EQ(
      irradiance({scene(), photons(), "--at", csv, "--add-to", first, "-o", first, "--passes", "20"}).code,
      0);
  EXPECT_EQ(records_in(first), filled);  // converged
}

TEST(Irradiance, AddingWithOtherOptionsIsRefused) {
  const std::string first = folder() + "/other.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), "--max-candidates", "50", "-o", first}).code, 0);
  const std::string before = slurp(first);
  expect_failure(irradiance({scene(), photons(), "--add-to", first, "--accuracy", "0.1", "-o", first}), 4,
                 "--accuracy");
  expect_failure(irradiance({scene(), photons(), "--add-to", first, "--paths", "all", "-o", first}), 4,
                 "--paths");
  const std::string others = folder() + "/others.photons";
  ASSERT_EQ(run_tool({"photons", scene(), "--photons", "1000", "--seed", "5", "-o", others}).code, 0);
  expect_failure(irradiance({scene(), others, "--add-to", first, "-o", first}), 4, "other photons");
  EXPECT_EQ(slurp(first), before);
}

TEST(Irradiance, BadInputs) {
  const std::string out = folder() + "/bad.irradiance";
  expect_failure(irradiance({scene(), folder() + "/missing.photons", "-o", out}), 3, "missing.photons");
  expect_failure(irradiance({folder() + "/missing.glb", photons(), "-o", out}), 3, "missing.glb");
  expect_failure(irradiance({scene(), scene(), "-o", out}), 2, "second scene");
  expect_failure(irradiance({photons(), photons(), "-o", out}), 2, "second photon map");
  expect_failure(irradiance({scene(), "-o", out}), 2, "count photons");
  expect_failure(irradiance({photons(), "-o", out}), 2, "no scene");
  expect_failure(irradiance({scene(), "--estimate", "gather", "-o", out}), 2, "earlier cache");
  expect_failure(irradiance({scene(), photons(), "--estimate", "gather", "--gradients", "blend", "-o", out}),
                 2, "gradients");
  expect_failure(irradiance({scene(), photons(), "--gather-bounces", "0", "-o", out}), 2, "gather-bounces");
  expect_failure(irradiance({data("spheres.glb"), photons(), "-o", out}), 4, "another scene");
  expect_failure(irradiance({scene(), photons(), "--accuracy", "0", "-o", out}), 2, "accuracy");
  expect_failure(irradiance({scene(), photons(), "--min-radius", "2", "--max-radius", "1", "-o", out}), 2,
                 "min-radius");
  expect_failure(irradiance({scene(), photons(), "-o", folder() + "/no/where.irradiance"}), 3,
                 "where.irradiance");
  const std::string csv = folder() + "/bad.csv";
  spill(csv, "x,y\n1,2\n");
  expect_failure(irradiance({scene(), photons(), "--at", csv, "-o", out}), 3, "bad.csv");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Irradiance, TruncatedPhotonsAreRefused) {
  const std::string whole = slurp(photons()), part = folder() + "/part.photons",
                    out = folder() + "/part.irradiance";
  for (const std::size_t size : {std::size_t{9}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    spill(part, whole.substr(0, size));
    const auto run = irradiance({scene(), part, "-o", out});
    EXPECT_TRUE(run.code == 3 || run.code == 2) << size << ": " << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

TEST(Irradiance, NoPhotonsGiveAnEmptyFileAndAWarning) {
  const std::string none = folder() + "/none.photons", out = folder() + "/none.irradiance";
  ASSERT_EQ(run_tool({"photons", scene(), "--photons", "0", "-o", none}).code, 0);
  const auto run = irradiance({scene(), none, "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("no photons"), std::string::npos) << run.err;
  EXPECT_EQ(records_in(out), 0u);
}

TEST(Irradiance, InterruptedItLeavesWhatWasThere) {
  const std::string out = folder() + "/kept.irradiance";
  spill(out, "earlier");
  const auto run = run_and_interrupt({"irradiance", scene(), photons(), "--probes", "65536",
                                      "--distance-rays", "4096", "--accuracy", "0.01", "-o", out},
                                     std::chrono::milliseconds(500));
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_EQ(slurp(out), "earlier");
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    EXPECT_EQ(entry.path().filename().string().find("kept.irradiance."), std::string::npos) << entry.path();
  }
}

TEST(Irradiance, HemisphereAndNoGradients) {
  for (const std::string mode : {"hemisphere", "none"}) {
    const std::string out = folder() + "/" + mode + ".irradiance";
    ASSERT_EQ(irradiance({scene(), photons(), "--gradients", mode, "-o", out}).code, 0);
    const Container file = Container::open(out);
    const std::size_t n = records_in(out);
    double sum = 0;
    for (const float g : file.values<float>("translation_gradient", {n, 3, 3}))
      sum += std::fabs(static_cast<double>(g));
    EXPECT_EQ(sum > 0, mode == "hemisphere");
  }
}

}  // namespace
}  // namespace phos::test
