// phos-brdf at the command line: what it says, what it refuses, and what it leaves behind.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/json.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos {
namespace {

using test::run_tool;

/// One triangle per material; each material is a JSON object.
std::string scene_of(const std::vector<std::string>& materials) {
  std::string list, primitives;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::string comma = i == 0 ? "" : ",";
    list += comma + materials[i];
    primitives += comma + R"({"attributes":{"POSITION":0},"material":)" + std::to_string(i) + "}";
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[)" +
         primitives + R"(]}],"materials":[)" + list +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-1],"max":[1,0,0]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
         R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}]})";
}

std::string phong(const std::string& name, double kd, double ks, double exponent) {
  const auto grey = [](double v) {
    const std::string one = std::to_string(v);
    return text("[", one, ",", one, ",", one, "]");
  };
  return R"({"name":")" + name + R"(","extras":{"phos":{"brdf":"phong","kd":)" + grey(kd) + R"(,"ks":)" +
         grey(ks) + R"(,"exponent":)" + std::to_string(exponent) + "}}}";
}

const char* const kMatt = R"({"name":"matt","extras":{"phos":{"brdf":"lambert","kd":[0.5,0.5,0.5]}}})";
const char* const kMirror = R"({"name":"mirror","extras":{"phos":{"brdf":"mirror","ks":[0.9,0.9,0.9]}}})";
const char* const kWard =
    R"({"name":"brushed","extras":{"phos":{"brdf":"ward","kd":[0,0,0],"ks":[0.6,0.6,0.6],"ax":0.6,"ay":0.4}}})";

class BrdfCli : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("brdf_cli"), out_ = folder_ + "/out.brdf"; }

  std::string file(const std::string& name, const std::string& bytes) {
    test::spill(folder_ + "/" + name, bytes);
    return folder_ + "/" + name;
  }
  std::string scene(const std::vector<std::string>& materials) {
    return file("scene.gltf", scene_of(materials));
  }
  void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& says) {
    std::vector<std::string> all{"brdf"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const test::Run run = run_tool(all);
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
    EXPECT_EQ(run.err.rfind("phos-brdf: ", 0), 0u) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_TRUE(run.out.empty()) << run.out;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
  Json stats() const { return parse_json(test::slurp(folder_ + "/stats.json"), "stats"); }

  std::string folder_, out_;
};

TEST_F(BrdfCli, HelpAndVersionGoToStdout) {
  for (const char* option : {"--help", "--version", "--man"}) {
    const test::Run run = run_tool({"brdf", option});
    EXPECT_EQ(run.code, 0);
    EXPECT_FALSE(run.out.empty());
    EXPECT_TRUE(run.err.empty());
  }
  const std::string help = run_tool({"brdf", "--help"}).out;
  for (const char* said : {"--error", "--max-order", "--resolution", "0.22"})
    EXPECT_NE(help.find(said), std::string::npos) << said;
}

TEST_F(BrdfCli, UsageErrors) {
  const std::string good = scene({phong("floor", 0, 0.5, 20)});
  expect_refused({}, 2, "SCENE");
  expect_refused({good}, 2, "output");
  for (const char* error : {"-0.1", "1.5", "nan", "little"})
    expect_refused({good, "-o", out_, "--error", error}, 2, "error");
  for (const char* order : {"0", "-3", "31", "200"})
    expect_refused({good, "-o", out_, "--max-order", order}, 2, "max-order");
  for (const char* resolution : {"0", "1", "100000"})
    expect_refused({good, "-o", out_, "--resolution", resolution}, 2, "resolution");
}

TEST_F(BrdfCli, BadScenes) {
  expect_refused({folder_ + "/absent.glb", "-o", out_}, 3, "absent.glb");
  expect_refused({file("text.glb", "this is no scene\n"), "-o", out_}, 3, "text.glb");
}

TEST_F(BrdfCli, NothingGlossyHere) {
  const test::Run run = run_tool({"brdf", scene({kMatt, kMirror}), "-o", out_});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("the scene has no gloss"), std::string::npos) << run.err;
  EXPECT_TRUE(Container::open(out_, FileKind::brdf).tensors().empty());
}

TEST_F(BrdfCli, ReportsEachMaterial) {
  const test::Run run =
      run_tool({"brdf", scene({kMatt, phong("floor", 0.1, 0.5, 22), kWard, phong("lacquer", 0, 0.5, 5000)}),
                "--resolution", "8", "-o", out_, "--stats", folder_ + "/stats.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(run.out.empty());
  EXPECT_NE(run.err.find("\"floor\": phong, orders 8 to "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("\"brushed\": ward, anisotropic, "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("\"lacquer\": phong, every direction is to be traced"), std::string::npos)
      << run.err;
  const Json stats = this->stats();
  const Json::Array& materials = stats.find("materials")->as_array();
  ASSERT_EQ(materials.size(), 3u);
  const Json& floor = materials[0];
  EXPECT_EQ(floor.find("material")->as_string(), "floor");
  EXPECT_EQ(floor.find("index")->as_integer(), 1);
  EXPECT_EQ(floor.find("model")->as_string(), "phong");
  EXPECT_EQ(floor.find("order_least")->as_integer(), 8);
  EXPECT_LE(floor.find("error_worst")->as_number(), 0.01);
  EXPECT_GT(floor.find("error_mean")->as_number(), 0.003);
  EXPECT_NEAR(floor.find("albedo")->as_number(), 0.6, 1e-3);
  EXPECT_EQ(materials[2].find("traced_share")->as_number(), 1);
  // The sizes said are the sizes written.
  std::uint64_t said = 0, written = 0;
  for (const Json& m : materials) said += static_cast<std::uint64_t>(m.find("bytes")->as_integer());
  const Container file = Container::open(out_, FileKind::brdf);
  for (const auto& [name, tensor] : file.tensors()) written += tensor.bytes.size();
  EXPECT_EQ(said, written);
}

TEST_F(BrdfCli, SaysWhatGainsEnergy) {
  const test::Run run = run_tool({"brdf", scene({phong("bright", 0.5, 0.7, 20)}), "-o", out_, "--quiet"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("warning"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("\"bright\" gains energy"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("1.2"), std::string::npos) << run.err;
  const Container file = Container::open(out_, FileKind::brdf);
  EXPECT_GT(file.provenance().counters["BRDF with an albedo above 1"], 0u);
}

TEST_F(BrdfCli, SameBytesOnAnyNumberOfThreads) {
  const std::string path = scene({phong("floor", 0, 0.5, 20), kWard});
  std::string first;
  for (const char* threads : {"1", "2", "5"}) {
    ASSERT_EQ(run_tool({"brdf", path, "--resolution", "8", "-o", out_, "--threads", threads}).code, 0);
    if (first.empty()) first = test::slurp(out_);
    EXPECT_EQ(test::slurp(out_), first) << threads << " threads";
  }
}

TEST_F(BrdfCli, ReuseDoesNothingTwice) {
  const std::string path = scene({phong("floor", 0, 0.5, 20)});
  const std::vector<std::string> command{"brdf", path, "-o", out_, "--reuse"};
  ASSERT_EQ(run_tool(command).code, 0);
  const auto written = std::filesystem::last_write_time(out_);
  const test::Run again = run_tool(command);
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("up to date"), std::string::npos) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(out_), written);
  const test::Run why = run_tool({"brdf", path, "-o", out_, "--error", "0.02", "--why"});
  EXPECT_NE(why.out.find("error"), std::string::npos) << why.out;
}

TEST_F(BrdfCli, InfoShowsTheMaterials) {
  ASSERT_EQ(run_tool({"brdf", scene({phong("floor", 0, 0.5, 20)}), "--resolution", "8", "-o", out_}).code, 0);
  const test::Run info = run_tool({"info", out_});
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.out.find("kind        brdf 1"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("material floor"), std::string::npos) << info.out;
  EXPECT_EQ(run_tool({"info", out_, "--verify"}).code, 0);
  EXPECT_EQ(run_tool({"info", out_, "--dump", "0.coefficients"}).out.rfind("0.coefficients.0.r,", 0), 0u);
}

}  // namespace
}  // namespace phos
