// The journal of a film keeps every number of an estimate.
#include "temporal/journal.h"

#include <gtest/gtest.h>

#include "support/radiance_records.h"
#include "support/run.h"

namespace phos {
namespace {

/// Estimates that are there, by item; counts the estimates that are asked for.
struct Given : Estimator {
  std::vector<Made> all;
  mutable int asked = 0;
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Worker>(); }
  Made make(const RecordSite& site, Worker&) const override {
    ++asked;
    return all.at(site.item);
  }
};

TEST(EstimateJournal, KeepsRadianceWithAndWithoutFootprints) {
  const std::string path = test::scratch("estimates") + "/a.journal";
  Given given;
  for (RadianceRecord r : test::random_radiance(2, 3).records) {
    if (!given.all.empty()) r.footprint_m = {1, 2, 3, 4, 5, 6, 7, 8};
    Made& made = given.all.emplace_back(Made{irradiance_of(r)});
    made.radiance = std::make_shared<RadianceRecord>(r);
    made.ahead = std::make_shared<Ahead>(Ahead{made.record, made.radiance, 0.1f});
  }
  for (const bool go_on : {false, true}) {
    EstimateJournal journal(path, "key", go_on);
    EXPECT_EQ(journal.found(), go_on ? given.all.size() : 0);
    const JournalEstimator kept(given, journal, 7);
    const auto worker = kept.make_worker();
    for (std::size_t i = 0; i < given.all.size(); ++i) {
      RecordSite site;
      site.item = i;
      const Made made = kept.make(site, *worker), &expected = given.all[i];
      for (const auto& radiance : {made.radiance, made.ahead->radiance}) {
        EXPECT_EQ(radiance->light, expected.radiance->light);
        EXPECT_EQ(radiance->footprint_m, expected.radiance->footprint_m);
      }
      ASSERT_EQ(made.record.footprint != nullptr, i > 0);
      if (i > 0) {
        EXPECT_EQ(made.record.footprint->lengths_m(), *expected.radiance->footprint_m);
      }
    }
  }
  EXPECT_EQ(given.asked, 2) << "those of the first run are not made again";
}

}  // namespace
}  // namespace phos
