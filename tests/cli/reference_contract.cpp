// phos-reference as a user meets it: exit codes, messages, files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");

TEST(ReferenceTool, HelpAndVersion) {
  const auto help = run_tool({"reference", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word :
       {"--samples", "--error", "--bounces", "--points", "--black-emitters", "--camera", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_tool({"reference", "--version"}).code, 0);
}

TEST(ReferenceTool, RefusesBadCommandLines) {
  const std::string out = scratch("reference-usage") + "/x.exr";
  EXPECT_EQ(run_tool({"reference"}).code, 2);
  expect_refused("reference", {kBox}, 2, "-o");
  expect_refused("reference", {kBox, "-o", out, "--samples", "0"}, 2, "samples");
  expect_refused("reference", {kBox, "-o", out, "--error", "0"}, 2, "error");
  expect_refused("reference", {kBox, "-o", out, "--no-such-option"}, 2, "no-such-option");
  expect_refused("reference", {kBox, "-o", out, "--camera", "nobody", "--samples", "1"}, 2, "left-view");
  const std::string points = scratch("reference-usage") + "/p.csv";
  spill(points, "0.5,0.001,0.5,0,1,0\n");
  expect_refused("reference", {kBox, "--points", points, "--adaptive"}, 2, "--adaptive");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(ReferenceTool, RefusesBadInput) {
  const std::string folder = scratch("reference-input"), out = folder + "/x.exr";
  expect_refused("reference", {folder + "/none.glb", "-o", out}, 3, "none.glb");
  spill(folder + "/text.glb", "not a scene at all\n");
  expect_refused("reference", {folder + "/text.glb", "-o", out}, 3, "text.glb");
  spill(folder + "/cut.glb", slurp(kBox).substr(0, 5000));
  expect_refused("reference", {folder + "/cut.glb", "-o", out}, 3, "cut.glb");
  expect_refused("reference", {kBox, "-o", folder + "/no/such/x.exr", "--samples", "1"}, 3, "x.exr");
  spill(folder + "/p.csv", "1,2,3,0,1,0\n1,2\n");
  expect_refused("reference", {kBox, "--points", folder + "/p.csv"}, 3, "p.csv:2");
  expect_refused("reference", {kBox, "--points", folder + "/none.csv"}, 3, "none.csv");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(ReferenceTool, SameBytesOnAnyNumberOfThreads) {
  const std::string folder = scratch("reference-threads"), one = folder + "/1.exr", two = folder + "/2.exr";
  for (const auto& [threads, out] : {std::pair{"1", one}, std::pair{"2", two}})
    ASSERT_EQ(
        run_tool({"reference", kBox, "--width", "40", "--samples", "4", "--threads", threads, "-o", out})
            .code,
        0);
  EXPECT_EQ(slurp(one), slurp(two));
  const Image image = read_image(one);
  EXPECT_EQ(image.width(), 40);
  for (const char* layer : {"", "direct", "indirect", "emission", "stderr", "indirect_stderr", "albedo"})
    EXPECT_TRUE(image.has_layer(layer)) << layer;
  for (const auto& [name, values] : image.channels())
    for (const float v : values) ASSERT_TRUE(std::isfinite(v)) << name;
  EXPECT_NE(image.attributes.at("phos.command").find("--samples 4"), std::string::npos);
}

TEST(ReferenceTool, SharesSamplesOutAlikeOnAnyNumberOfThreads) {
  const std::string folder = scratch("reference-adaptive");
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(run_tool({"reference", kBox, "--width", "40", "--samples", "40", "--adaptive", "--threads",
                        threads, "-o", folder + "/" + threads + ".exr"})
                  .code,
              0);
  EXPECT_EQ(slurp(folder + "/1.exr"), slurp(folder + "/3.exr"));
}

TEST(ReferenceTool, ReusesWhatIsThere) {
  const std::string folder = scratch("reference-reuse"), out = folder + "/x.exr";
  const std::vector<std::string> command{"reference", kBox, "--width", "30", "--samples", "2", "-o", out};
  ASSERT_EQ(run_tool(command).code, 0);
  const auto written = std::filesystem::last_write_time(out);
  std::vector<std::string> again = command;
  again.push_back("--reuse");
  EXPECT_EQ(run_tool(again).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(out), written);
  again.insert(again.end(), {"--seed", "1"});
  EXPECT_EQ(run_tool(again).code, 0);
  EXPECT_NE(std::filesystem::last_write_time(out), written);
}

TEST(ReferenceTool, PointsToStdoutOrFile) {
  const std::string folder = scratch("reference-points");
  spill(folder + "/p.csv", "x,y,z,nx,ny,nz\n0.45,0.001,0.1,0,1,0\n0.45,0.001,0.1,0,-1,0\n");
  const std::vector<std::string> command{"reference",       kBox,        "--points",
                                         folder + "/p.csv", "--samples", "2000"};
  const auto run = run_tool(command);
  ASSERT_EQ(run.code, 0) << run.err;
  std::istringstream lines(run.out);
  std::string heading, up, down;
  std::getline(lines, heading), std::getline(lines, up), std::getline(lines, down);
  EXPECT_EQ(heading, "x,y,z,nx,ny,nz,illuminance_lx,stderr_lx,r_lx,g_lx,b_lx");
  EXPECT_EQ(up.rfind("0.45,0.001,0.1,0,1,0,", 0), 0u) << up;
  EXPECT_GT(std::stod(up.substr(21)), 10) << up;
  std::vector<std::string> to_file = command;
  to_file.insert(to_file.end(), {"-o", folder + "/e.csv"});
  EXPECT_EQ(run_tool(to_file).code, 0);
  EXPECT_EQ(slurp(folder + "/e.csv"), run.out);
}

TEST(ReferenceTool, StopsAtTheAskedError) {
  const std::string folder = scratch("reference-error"), out = folder + "/x.exr";
  const auto run =
      run_tool({"reference", kBox, "--width", "30", "--error", "0.1", "--samples", "100000", "-o", out});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto attributes = read_image(out).attributes;
  EXPECT_LE(std::stod(attributes.at("phos.error")), 0.1);
  EXPECT_LT(std::stol(attributes.at("phos.samples")), 2000);
  const auto cut =
      run_tool({"reference", kBox, "--width", "30", "--error", "0.001", "--samples", "8", "-o", out});
  EXPECT_EQ(cut.code, 0);
  EXPECT_NE(cut.err.find("not reached"), std::string::npos) << cut.err;
}

TEST(ReferenceTool, InterruptLeavesWhatWasThere) {
  const std::string folder = scratch("reference-interrupt"), out = folder + "/x.exr";
  spill(out, "earlier");
  const auto run = run_and_interrupt({"reference", kBox, "--samples", "1000000", "-o", out},
                                     std::chrono::milliseconds(700));
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_EQ(slurp(out), "earlier");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  EXPECT_EQ(files, 1u);
}

}  // namespace
