// phos-view --static as a user meets it: one file, the same every time, and refusals that leave no file.
#include <gtest/gtest.h>

#include "support/refused.h"
#include "support/run.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");

/// A cache of the box, made once.
const std::string& folder() {
  static const std::string made = [] {
    std::string f = scratch("view-static");
    EXPECT_EQ(run_tool({"photons", kBox, "--photons", "20000", "-o", f + "/box.photons"}).code, 0);
    EXPECT_EQ(
        run_tool({"irradiance", kBox, f + "/box.photons", "--place", "surface", "-o", f + "/box.irradiance"})
            .code,
        0);
    return f;
  }();
  return made;
}

std::string cache() { return folder() + "/box.irradiance"; }

std::size_t files_in(const std::string& path) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
}

TEST(ViewStaticTool, WritesOneFileAndEnds) {
  const std::string one = folder() + "/one.html", two = folder() + "/two.html";
  const test::Run run = run_tool({"view", kBox, cache(), "--static", one});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "");  // no address
  EXPECT_NE(run.err.find("rounded"), std::string::npos) << run.err;
  const std::string page = slurp(one);
  EXPECT_EQ(page.substr(0, 15), "<!doctype html>");
  EXPECT_EQ(page.find(folder()), std::string::npos);  // no path
  EXPECT_NE(page.find("\"command\": \"phos-view "), std::string::npos);
  EXPECT_EQ(run_tool({"view", kBox, cache(), "--static", two, "--threads", "2", "--quiet"}).err, "");
  EXPECT_EQ(slurp(two), page);
  EXPECT_EQ(run_tool({"view", kBox, cache(), "--static", two, "--lamp-places", "4"}).code, 0);
  EXPECT_NE(slurp(two), page);
}

TEST(ViewStaticTool, RefusalsLeaveWhatWasThere) {
  const std::string place = folder() + "/refused", page = place + "/room.html";
  std::filesystem::create_directories(place);
  spill(page, "before");
  const auto refused = [&](std::vector<std::string> options, int code, const std::string& words) {
    options.insert(options.begin(), {kBox, cache()});
    expect_refused("view", options, code, words);
    EXPECT_EQ(slurp(page), "before");
    EXPECT_EQ(files_in(place), 1u);
  };
  refused({"--static", page, "--port", "0"}, 2, "--port");
  refused({"--static", page, "--host", "127.0.0.1"}, 2, "--host");
  refused({"--static", page, "--texture-size", "0"}, 2, "texture-size");
  refused({"--texture-size", "64"}, 2, "--static");
  refused({"--static", ""}, 2, "--static");
  refused({"--static", place + "/none/room.html"}, 3, "none");
  spill(folder() + "/cut.irradiance", slurp(cache()).substr(0, 3000));
  expect_refused("view", {kBox, folder() + "/cut.irradiance", "--static", page}, 3, "cut.irradiance");
  EXPECT_EQ(slurp(page), "before");
  const std::string whole = slurp(cache());
  expect_refused("view", {kBox, cache(), "--static", cache()}, 2, "input");
  EXPECT_EQ(slurp(cache()), whole);
}

}  // namespace
