// phos-view as a user meets it: refusals before it serves, its address, its end; light under the cursor.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "support/http_client.h"
#include "support/refused.h"
#include "support/view_program.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");

/// Photons and a cache of the box, made once.
const std::string& box_folder() {
  static const std::string folder = [] {
    std::string f = scratch("view-box");
    EXPECT_EQ(run_tool({"photons", kBox, "--photons", "60000", "-o", f + "/box.photons"}).code, 0);
    EXPECT_EQ(
        run_tool({"irradiance", kBox, f + "/box.photons", "--place", "surface", "-o", f + "/box.irradiance"})
            .code,
        0);
    EXPECT_EQ(run_tool({"irradiance", kBox, f + "/box.photons", "--estimate", "gather", "--rays", "64",
                        "--footprint", "adaptive", "-o", f + "/adaptive.irradiance"})
                  .code,
              0);
    return f;
  }();
  return folder;
}

/// A field of a message as bytes: the k-th of MessageLayout.
std::string question(const std::vector<float>& origin, const std::vector<float>& direction) {
  const auto bytes = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::uint64_t one = 1;
  std::string s = bytes(one) + bytes(std::uint32_t{5}) + std::string(4, '\0');
  for (const std::vector<float>* v : {&origin, &direction})
    s += bytes(one) + bytes((*v)[0]) + bytes((*v)[1]) + bytes((*v)[2]) + std::string(4, '\0');
  return "phov" + bytes(std::uint16_t{1}) + bytes(std::uint16_t{3}) + bytes(std::uint64_t{s.size() + 16}) + s;
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value{};
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(ViewTool, HelpAndVersion) {
  const auto help = run_tool({"view", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--port", "--host", "--accuracy", "--lamp-places", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_tool({"view", "--version"}).code, 0);
}

TEST(ViewTool, RefusesBeforeItServes) {
  const std::string cache = box_folder() + "/box.irradiance";
  EXPECT_EQ(run_tool({"view"}).code, 2);
  EXPECT_EQ(run_tool({"view", kBox}).code, 2);
  expect_refused("view", {kBox, cache, "--port", "65536"}, 2, "port");
  expect_refused("view", {kBox, cache, "--port", "0", "--host", "203.0.113.7"}, 2, "--host");
  expect_refused("view", {"missing.glb", cache}, 3, "missing.glb");
  expect_refused("view", {kBox, box_folder() + "/box.photons"}, 3, "photons");
  expect_refused("view", {data("cornell-glossy22.glb"), cache}, 4, "box.irradiance");
  expect_refused("view", {kBox, box_folder() + "/adaptive.irradiance"}, 2, "adaptive");
  spill(box_folder() + "/cut.irradiance", slurp(cache).substr(0, 3000));
  expect_refused("view", {kBox, box_folder() + "/cut.irradiance"}, 3, "cut.irradiance");
}

TEST(ViewTool, ServesAndEnds) {
  const std::string cache = box_folder() + "/box.irradiance";
  ViewProgram view({kBox, cache});
  ASSERT_NE(view.port(), 0u);
  for (const char* path : {"/", "/view.js", "/view.css", "/scene.bin", "/records.bin", "/format.json",
                           "/about.json", "/weight.glsl", "/palette.bin", "/splat.frag.glsl"})
    EXPECT_EQ(status(get(view.port(), path)), 200) << path;
  for (const std::string& path : {std::string("/box.irradiance"), cache, kBox, std::string("/etc/passwd")})
    EXPECT_EQ(status(get(view.port(), path)), 404) << path;
  EXPECT_EQ(status(get(view.port(), "/", "evil.example")), 403);
  // "carried_light(" is of the text that C++ and GLSL share.
  EXPECT_NE(get(view.port(), "/weight.glsl").find("carried_light("), std::string::npos);

  expect_refused("view", {kBox, cache, "--port", std::to_string(view.port())}, 2, "another port");
  const test::Run end = view.end();
  EXPECT_EQ(end.code, 0) << end.err;
}

TEST(ViewTool, LightUnderTheCursorIsThatOfSense) {
  ViewProgram view({kBox, box_folder() + "/box.irradiance"});
  ASSERT_NE(view.port(), 0u);
  const HttpClient client(view.port());
  client.send(handshake(""));
  ASSERT_EQ(status(client.read_to("\r\n\r\n")), 101);
  int hits = 0;
  for (const auto& [x, z] : {std::pair(0.1f, 0.1f), {0.3f, 0.05f}, {0.45f, 0.4f}, {5.f, 5.f}}) {
    client.send(frame(question({x, 0.54f, z}, {0, -3, 0}), 2));
    const std::string head = client.read(4);
    ASSERT_EQ(head.substr(0, 2), "\x82\x7e");
    const std::string reading =
        client.read(256u * static_cast<unsigned char>(head[2]) + static_cast<unsigned char>(head[3]));
    // Each field: its rows, its values, zeros to 8 bytes.
    EXPECT_EQ(number_at<std::uint32_t>(reading, 16 + 8), 5u);
    const auto hit = number_at<std::uint32_t>(reading, 32 + 8);
    const std::size_t position = 48 + 8, normal = 72 + 8, lux = 96 + 8, stderr_lx = 112 + 8;
    if (hit == 0) {
      EXPECT_EQ(number_at<float>(reading, lux), 0);
      continue;
    }
    ++hits;
    std::ostringstream point;
    point.precision(9);
    for (const std::size_t at : {position, normal})
      for (std::size_t k = 0; k < 3; ++k) point << number_at<float>(reading, at + 4 * k) << ' ';
    spill(box_folder() + "/point.txt", point.str() + "\n");
    const test::Run sense =
        run_tool({"sense", kBox, box_folder() + "/box.irradiance", "--points", box_folder() + "/point.txt"});
    ASSERT_EQ(sense.code, 0) << sense.err;
    std::istringstream row(sense.out.substr(sense.out.find('\n') + 1));
    std::vector<double> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(std::strtod(cell.c_str(), nullptr));
    ASSERT_EQ(cells.size(), 11u);
    EXPECT_GT(cells[7], 0);
    EXPECT_NEAR(static_cast<double>(number_at<float>(reading, lux)), cells[7], 0.005 * cells[7]);
    EXPECT_NEAR(static_cast<double>(number_at<float>(reading, stderr_lx)), cells[8], 0.02 * cells[8]);
  }
  EXPECT_GE(hits, 2);
}

}  // namespace
