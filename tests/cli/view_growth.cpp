// phos-view lets a cache grow: the saved file, its records, and who may ask.
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "support/refused.h"
#include "support/view_program.h"
#include "support/wishes.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");

/// Photons of the box, and caches of few records, made once.
const std::string& box_folder() {
  static const std::string folder = [] {
    std::string f = scratch("view-growth");
    const auto make = [](const std::vector<std::string>& command) { EXPECT_EQ(run_tool(command).code, 0); };
    make({"photons", kBox, "--photons", "60000", "-o", f + "/box.photons"});
    make({"photons", kBox, "--photons", "5000", "--seed", "9", "-o", f + "/other.photons"});
    for (const char* estimate : {"hull", "gather"})
      make({"irradiance", kBox, f + "/box.photons", "--estimate", estimate, "--rays", "64", "--place",
            "photons", "--max-candidates", "6", "-o", f + "/" + estimate + ".irradiance"});
    return f;
  }();
  return folder;
}

std::string in(const std::string& name) { return box_folder() + "/" + name; }

/// A wish for records on the floor of the box.
std::string floor_wish(const WishingPage& page, bool save = false) {
  WishingPage::Points position, normal;
  for (int i = 0; i < 80; ++i) {
    position.push_back(
        {0.05f + 0.05f * static_cast<float>(i % 10), 0, 0.05f + 0.05f * static_cast<float>(i / 10)});
    normal.push_back({0, 1, 0});
  }
  return page.wish(position, normal, save);
}

std::string dump(const std::string& file, const std::string& tensors) {
  const test::Run run = run_tool({"info", file, "--dump", tensors});
  EXPECT_EQ(run.code, 0) << run.err;
  return run.out;
}

std::size_t rows(const std::string& csv) {
  return static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) - 1;
}

/// The file that a walk over the floor saves at its end.
void walk(const std::vector<std::string>& inputs, const std::string& saved) {
  std::vector<std::string> arguments = inputs;
  arguments.insert(arguments.end(), {"--save", saved});
  ViewProgram view(arguments);
  ASSERT_NE(view.port(), 0u);
  const WishingPage page(view.port());
  EXPECT_GT(page.settle(floor_wish(page)).records, 5u);
  EXPECT_FALSE(std::filesystem::exists(saved));
  const test::Run end = view.end();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(run_tool({"info", saved, "--verify"}).code, 0);
}

/// The records of the saved file are those of phos-irradiance at the same places.
void expect_placed(const std::string& cache, const std::string& saved, const std::vector<std::string>& from) {
  const std::size_t before = rows(dump(cache, "radius"));
  std::istringstream places(dump(saved, "position,normal"));
  std::string line, csv = "x,y,z,nx,ny,nz\n";
  std::getline(places, line);
  for (std::size_t i = 0; std::getline(places, line); ++i)
    if (i >= before) csv += line + "\n";
  spill(in("places.csv"), csv);
  std::vector<std::string> command = {"irradiance", kBox};
  command.insert(command.end(), from.begin(), from.end());
  command.insert(command.end(), {"--add-to", cache, "--at", in("places.csv"), "--place", "every", "-o",
                                 in("placed.irradiance")});
  const test::Run run = run_tool(command);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* tensor : {"position", "normal", "irradiance", "stderr", "distance", "radius",
                             "rotation_gradient", "translation_gradient"})
    EXPECT_EQ(dump(saved, tensor), dump(in("placed.irradiance"), tensor)) << tensor;
}

TEST(ViewGrowth, PhotonRecordsAreThoseOfIrradiance) {
  walk({kBox, in("hull.irradiance"), in("box.photons")}, in("walked.irradiance"));
  expect_placed(in("hull.irradiance"), in("walked.irradiance"), {in("box.photons")});
  EXPECT_EQ(run_tool({"irradiance", kBox, in("box.photons"), "--add-to", in("walked.irradiance"), "-o",
                      in("more.irradiance")})
                .code,
            0);
  EXPECT_EQ(run_tool({"sense", kBox, in("walked.irradiance"), "--points", in("places.csv")}).code, 0);
}

TEST(ViewGrowth, GatheredRecordsAreThoseOfIrradiance) {
  walk({kBox, in("gather.irradiance"), in("box.photons")}, in("gathered.irradiance"));
  expect_placed(in("gather.irradiance"), in("gathered.irradiance"), {in("box.photons")});
}

TEST(ViewGrowth, WithoutPhotonsRaysReadTheCache) {
  walk({kBox, in("gather.irradiance")}, in("read.irradiance"));
  expect_placed(in("gather.irradiance"), in("read.irradiance"), {in("gather.irradiance")});
  walk({kBox, in("hull.irradiance")}, in("mixed.irradiance"));
  EXPECT_EQ(run_tool({"info", in("mixed.irradiance"), "--verify"}).code, 0);
}

TEST(ViewGrowth, SavesWhenAPageAsks) {
  const std::string saved = in("asked.irradiance");
  ViewProgram view({kBox, in("hull.irradiance"), in("box.photons"), "--save", saved});
  ASSERT_NE(view.port(), 0u);
  const WishingPage page(view.port());
  const WishingPage::Answer answer = page.settle(floor_wish(page));
  EXPECT_EQ(page.settle(page.wish({}, {}, true), 1).saves, 1u);
  EXPECT_EQ(rows(dump(saved, "radius")), rows(dump(in("hull.irradiance"), "radius")) + answer.records);
}

TEST(ViewGrowth, BadWishesEndTheirConnectionAlone) {
  ViewProgram view({kBox, in("hull.irradiance"), in("box.photons"), "--records-per-frame", "3"});
  ASSERT_NE(view.port(), 0u);
  const WishingPage good(view.port());
  const float inf = std::numeric_limits<float>::infinity();
  for (const WishingPage::Points& position :
       {WishingPage::Points{{inf, 0, 0}},
        {{1e6f, 0, 0}},
        {{0, 0, -9}},
        {{0.1f, 0, 0.1f}, {0.2f, 0, 0.1f}, {0.1f, 0, 0.2f}, {0.2f, 0, 0.2f}}}) {
    const WishingPage page(view.port());
    page.client().send(frame(page.wish(position, WishingPage::Points(position.size(), {0, 1, 0})), 2));
    EXPECT_EQ(page.client().read(1), "\x88") << "a frame that closes";
    EXPECT_EQ(good.ask(good.wish({}, {})).records, 0u);
  }
  EXPECT_GT(good.settle(good.wish({{0.1f, 0, 0.1f}}, {{0, 1, 0}})).records, 0u);
}

TEST(ViewGrowth, Refusals) {
  const std::string cache = in("hull.irradiance"), photons = in("box.photons");
  expect_refused("view", {kBox, cache, photons, in("other.photons")}, 2, "second photon map");
  expect_refused("view", {kBox, cache, in("other.photons")}, 4, "other photons");
  expect_refused("view", {kBox, cache, "--records-per-frame", "1001"}, 2, "records-per-frame");
  expect_refused("view", {kBox, cache, "--records-per-frame", "0", "--save", in("no.irradiance")}, 2,
                 "--save");
  expect_refused("view", {kBox, cache, "--save", cache}, 2, "--save");
  expect_refused("view", {kBox, cache, "--save", box_folder() + "/missing/x.irradiance"}, 3, "missing");
}

}  // namespace
