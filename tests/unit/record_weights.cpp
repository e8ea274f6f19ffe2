// Records of a film that fade: their own weight beside that of their place.
#include <gtest/gtest.h>

#include "radiance/cache.h"
#include "radiance/gloss_cache.h"
#include "radiance/tree.h"
#include "record/far_records.h"
#include "record/tree.h"

namespace phos {
namespace {

constexpr Vec3 kMiddle(0), kUp(0, 0, 1);

/// Two records as far from the middle as each other, on either side.
std::vector<IrradianceRecord> two(float weight) {
  std::vector<IrradianceRecord> out(2);
  for (int i = 0; i < 2; ++i) {
    IrradianceRecord& r = out[static_cast<std::size_t>(i)];
    r.position = Vec3(i == 0 ? -0.25f : 0.25f, 0, 0);
    r.radius_m = 4;
    r.irradiance = Rgb(i == 0 ? 10.f : 50.f), r.stderr_lx = Rgb(i == 0 ? 1.f : 2.f);
  }
  out[1].weight = weight;
  return out;
}

RecordTree tree_of(const std::vector<IrradianceRecord>& records, double accuracy = 0.25) {
  RecordTree tree({Vec3(-1), Vec3(1)}, accuracy);
  for (const IrradianceRecord& r : records) tree.insert(r);
  return tree;
}

/// Of the mean of records that say 10 and 50 with errors of 1 and 2, the second of weight 1/4
/// (blended_error).
float error_of_both() {
  const double q = (1 + 0.0625) / (1.25 * 1.25), own = 1 - double(kSharedByZones), error = 1.2, mean = 18;
  const double scatter = (100 + 0.25 * 2500) / 1.25 - mean * mean;
  return static_cast<float>(
      std::sqrt(error * error * (1 - own + own * q) +
                kCommonOfPhotons * (scatter - kCarriedNoise * own * error * error * (1 - q))));
}

TEST(RecordWeights, BlendExactly) {
  // Weights of place: 1 - (0.25 / 4) / 0.25 = 3/4 each.
  const Interpolated even = tree_of(two(1)).interpolate(kMiddle, kUp),
                     faded = tree_of(two(0.25f)).interpolate(kMiddle, kUp);
  EXPECT_EQ(even.weight, 1.5f);
  EXPECT_EQ(even.irradiance, Rgb(30));
  EXPECT_EQ(faded.weight, 0.75f * 1.25f);
  EXPECT_FLOAT_EQ(faded.irradiance.x, (10 + 0.25f * 50) / 1.25f);
  EXPECT_FLOAT_EQ(faded.stderr_lx.x, error_of_both());
}

TEST(RecordWeights, AloneIsItsOwn) {
  std::vector<IrradianceRecord> one = two(0.01f);
  one.erase(one.begin());
  const RecordTree tree = tree_of(one);
  EXPECT_TRUE(tree.covered(kMiddle, kUp));
  EXPECT_FLOAT_EQ(tree.interpolate(kMiddle, kUp).irradiance.x, 50);
  std::vector<const IrradianceRecord*> found;
  tree.valid(kMiddle, kUp, found);
  EXPECT_EQ(found.size(), 1u);
  // 2 m away, where records at rest reach no more than 1 m.
  const RecordTree all = tree_of(two(0.25f));
  const FarRecords far(all);
  const Interpolated beyond = far.interpolate({0, 1.5f, 0}, kUp);
  EXPECT_FLOAT_EQ(beyond.irradiance.x, (10 + 0.25f * 50) / 1.25f);
  float weight = 0;
  EXPECT_EQ(far.irradiance({0, 1.5f, 0}, kUp, weight), beyond.irradiance);
  EXPECT_EQ(weight, beyond.weight);
  EXPECT_EQ(far.irradiance({0, 9, 0}, kUp, weight), Rgb(0));  // beyond four times their reach
  EXPECT_EQ(weight, 0.f);
}

/// Radiance records of the same light: a constant, which comes out of any lobe by the same share.
std::vector<RadianceRecord> two_radiance(int order, float weight) {
  std::vector<RadianceRecord> out;
  for (const IrradianceRecord& r : two(weight)) {
    RadianceRecord made;
    made.position = r.position, made.frame = make_frame(r.normal);
    made.radius_m = r.radius_m, made.weight = r.weight;
    made.light.assign(static_cast<std::size_t>(3 * order * order), 0);
    std::fill_n(made.light.begin(), 3, r.irradiance.x);
    made.stderr_light.assign(static_cast<std::size_t>(3 * order), r.stderr_lx.x);
    out.push_back(made);
  }
  return out;
}

TEST(RecordWeights, OfRadiance) {
  for (const int order : {1, 3}) {
    RadianceTree tree({Vec3(-1), Vec3(1)}, 0.25, order);
    for (const RadianceRecord& r : two_radiance(order, 0.25f)) tree.insert(r);
    RadianceTree::Worker worker;
    const float share = (10 + 0.25f * 50) / 1.25f;
    const float error = 1.2f * std::sqrt(kSharedByZones + (1 - kSharedByZones) * 0.68f);
    // In the records' own frame and in one that is turned.
    for (const Frame& frame : {make_frame(kUp), Frame{{0, 1, 0}, {-1, 0, 0}, kUp}}) {
      EXPECT_EQ(tree.interpolate(kMiddle, frame, order, worker), 0.75f * 1.25f);
      EXPECT_FLOAT_EQ(worker.light[0], share);
      EXPECT_FLOAT_EQ(worker.stderr_light[0], error);
      std::vector<float> lobe(static_cast<std::size_t>(3 * order * order), 0);
      std::fill_n(lobe.begin(), 3, 2.f);
      const GlossyLight light = tree.outgoing(kMiddle, frame, lobe, Rgb(0), worker);
      EXPECT_EQ(light.weight, 0.75f * 1.25f);
      EXPECT_FLOAT_EQ(light.radiance.x, 2 * share);
      EXPECT_NEAR(light.stderr_cd.x, 2 * error_of_both(), 1e-4f);
    }
    EXPECT_EQ(tree.irradiance().records()[1].weight, 0.25f);
  }
}

}  // namespace
}  // namespace phos
