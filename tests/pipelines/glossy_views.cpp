// A cache that grows from view to view, at toy size.
#include <gtest/gtest.h>

#include "file/csv.h"
#include "image/image.h"
#include "support/script.h"

namespace phos::test {
namespace {

class GlossyViews : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-glossy-views"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  test::Run views(std::vector<std::string> cameras) const {
    std::vector<std::string> all = {data("cornell-glossy22.glb"), "out"};
    all.insert(all.end(), cameras.begin(), cameras.end());
    for (const char* word : {"--photons", "20000", "--width", "40", "--rays", "256", "--samples", "1"})
      all.emplace_back(word);
    return run_script("glossy-views.sh", all, folder_);
  }
  std::string folder_;
};

TEST_F(GlossyViews, AddWhatTheOnesBeforeThemDidNotLeave) {
  const test::Run run = views({"measured", "left-view", "measured"});
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable counts = parse_csv(slurp(folder_ + "/out/records.csv"), "records.csv");
  ASSERT_EQ(counts.rows.size(), 3u) << run.out;
  for (const char* kind : {"radiance", "irradiance"}) {
    const std::size_t all = counts.column(std::string(kind) + "_records", ""),
                      fresh = counts.column(std::string(kind) + "_new", "");
    EXPECT_EQ(counts.number(0, all), counts.number(0, fresh));
    EXPECT_GT(counts.number(0, fresh), 0);
    EXPECT_GT(counts.number(1, fresh), 0) << kind;
    EXPECT_LT(counts.number(1, fresh), 0.6 * counts.number(0, fresh)) << kind;
    EXPECT_EQ(counts.number(1, all), counts.number(0, all) + counts.number(1, fresh));
    EXPECT_LT(counts.number(2, fresh), 0.1 * counts.number(0, fresh)) << kind << ": seen before";
  }
  for (const char* camera : {"measured", "left-view"}) {
    const Image image = read_image(folder_ + "/out/" + camera + ".exr");
    float gloss = 0;
    for (const float v : image.channel("glossy.G")) gloss = std::max(gloss, v);
    EXPECT_GT(gloss, 0) << camera;
  }
}

TEST_F(GlossyViews, WrongInputsAreNamed) {
  EXPECT_EQ(run_script("glossy-views.sh", {data("cornell-glossy22.glb"), "out"}, folder_).code, 2);
  const test::Run none = run_script("glossy-views.sh", {"nowhere.glb", "out", "measured"}, folder_);
  EXPECT_EQ(none.code, 3);
  EXPECT_NE(none.err.find("nowhere.glb: no such file"), std::string::npos) << none.err;
  const test::Run camera = views({"backstage"});
  EXPECT_EQ(camera.code, 2);
  EXPECT_NE(camera.err.find("backstage"), std::string::npos) << camera.err;
}

}  // namespace
}  // namespace phos::test
