// phos-view as a user meets it: refusals before it serves, its address, its end; light under the cursor.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "support/http_client.h"
#include "support/lamp_groups.h"
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

/// A question by the fields of MessageLayout: number 5, set, origin, direction, weights.
std::string question(const std::vector<float>& origin, const std::vector<float>& direction,
                     const std::vector<float>& weights = {1}, std::uint32_t set = 0) {
  const auto bytes = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::uint64_t one = 1;
  std::string s = bytes(one) + bytes(std::uint32_t{5}) + std::string(4, '\0');
  s += bytes(one) + bytes(set) + std::string(4, '\0');
  for (const std::vector<float>* v : {&origin, &direction})
    s += bytes(one) + bytes((*v)[0]) + bytes((*v)[1]) + bytes((*v)[2]) + std::string(4, '\0');
  s += bytes(std::uint64_t{weights.size()});
  for (const float weight : weights) s += bytes(weight);
  s.resize((s.size() + 7) / 8 * 8, '\0');
  return "phov" + bytes(std::uint16_t{2}) + bytes(std::uint16_t{3}) + bytes(std::uint64_t{s.size() + 16}) + s;
}

/// The answer to a question, by a client whose socket is open.
std::string answer(const HttpClient& client, const std::string& asked) {
  client.send(frame(asked, 2));
  const std::string head = client.read(4);
  EXPECT_EQ(head.substr(0, 2), "\x82\x7e");
  if (head.size() < 4) return "";
  return client.read(256u * static_cast<unsigned char>(head[2]) + static_cast<unsigned char>(head[3]));
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
    const std::string reading = answer(client, question({x, 0.54f, z}, {0, -3, 0}));
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

/// Fields of a reading that are numbers: where their values stand.
enum Field : std::size_t {
  kIlluminance = 104,
  kStderr = 120,
  kDirect = 136,
  kIndirect = 152,
  kLuminance = 168
};

TEST(ViewTool, GroupsOfLamps) {
  const LampGroups groups = lamp_groups(scratch("view-groups"));
  const std::string left = groups.cache("left"), right = groups.cache("right"), all = groups.cache("all");
  expect_refused("view", {groups.scene, "a=" + left, "a=" + right}, 2, "second cache of the group \"a\"");
  expect_refused("view", {groups.scene, "a=" + left, right}, 2, "has no name");
  expect_refused("view", {groups.scene, "a=" + left, "b=" + left}, 2, "holds too");
  expect_refused("view", {groups.scene, "a=" + left, "b=" + all}, 2, "holds the light of all lamps");
  expect_refused("view", {groups.scene, "a=" + left, "--lamps", "spot"}, 2, "--lamps");
  expect_refused("view", {groups.scene, "left=" + left, "right=" + right, "--compare", "lefd=" + left}, 2,
                 "did you mean \"left\"?");
  expect_refused("view", {groups.scene, left, right}, 4, "was made with --lamps lamp-right,spot");
  expect_refused("view", {kBox, "left=" + left}, 4, "made from another scene");
  expect_refused("photons", {groups.scene, "--lamps", "lamp-lefd", "-o", groups.folder + "/x.photons"}, 2,
                 "did you mean \"lamp-left\"?");
  expect_refused("irradiance", {groups.scene, groups.folder + "/left.photons", "--lamps", "spot", "-o", left},
                 4, "was made with --lamps lamp-left, not with --lamps spot");

  std::vector<std::string> words = groups.named();
  words.insert(words.end(), {"--compare", all});
  ViewProgram view(words);
  ASSERT_NE(view.port(), 0u);
  EXPECT_EQ(status(get(view.port(), "/records-2.bin")), 200);
  EXPECT_EQ(status(get(view.port(), "/records-3.bin")), 404);
  const HttpClient client(view.port());
  client.send(handshake(""));
  ASSERT_EQ(status(client.read_to("\r\n\r\n")), 101);
  const std::vector<float> from{1.8f, 2, 1.3f}, down{0.1f, -1, 0};
  const auto read = [&](const std::vector<float>& weights, std::uint32_t set) {
    return answer(client, question(from, down, weights, set));
  };
  const std::string by_left = read({1, 0}, 0), by_right = read({0, 1}, 0), mixed = read({0.5f, 0.25f}, 0),
                    whole = read({1, 1}, 0), other = read({1}, 1);
  for (const Field field : {kIlluminance, kDirect, kIndirect, kLuminance}) {
    const float l = number_at<float>(by_left, field), r = number_at<float>(by_right, field);
    EXPECT_GT(l, 0) << field;
    EXPECT_GT(r, 0) << field;
    EXPECT_FLOAT_EQ(number_at<float>(mixed, field), 0.5f * l + 0.25f * r) << field;
    EXPECT_FLOAT_EQ(number_at<float>(whole, field), l + r) << field;
    EXPECT_NEAR(number_at<float>(other, field), l + r, 0.2f * (l + r)) << field;
  }
  EXPECT_FLOAT_EQ(number_at<float>(mixed, kStderr), std::hypot(0.5f * number_at<float>(by_left, kStderr),
                                                               0.25f * number_at<float>(by_right, kStderr)));
}

TEST(ViewTool, QuestionsThatDoNotFitCloseTheirConnection) {
  ViewProgram view({kBox, box_folder() + "/box.irradiance"});
  ASSERT_NE(view.port(), 0u);
  for (const std::string& asked :
       {question({0, 0, 0}, {0, 1, 0}, {1, 1}), question({0, 0, 0}, {0, 1, 0}, {}),
        question({0, 0, 0}, {0, 1, 0}, {-1}), question({0, 0, 0}, {0, 1, 0}, {1}, 1)}) {
    const HttpClient client(view.port());
    client.send(handshake(""));
    ASSERT_EQ(status(client.read_to("\r\n\r\n")), 101);
    client.send(frame(asked, 2));
    EXPECT_EQ(client.read(1), "\x88");  // a frame that closes
  }
}

}  // namespace
