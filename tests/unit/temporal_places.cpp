// Where the records of a film lie.
#include <gtest/gtest.h>

#include <algorithm>

#include "place/view_candidates.h"
#include "record/tree.h"
#include "support/filmed_slabs.h"
#include "temporal/make_film.h"

namespace phos {
namespace {

/// Share of what a frame shows, in a view 24 pixels wide, that its records do not serve as well as asked.
double ill_served(const FrameScene& at, const Film& film) {
  RecordTree records(at.scene.bounds, film.info.accuracy);
  for (const IrradianceRecord& r : cache_at(film, at.frame, at.scene).records) records.insert(r);
  const Candidates seen = view_candidates(at.rays, {at.scene.camera[0], 24, 24, 0, 0}, {});
  std::vector<RecordSite> sites;
  for (std::size_t i = 0; i < seen.count; ++i) seen.sites(i, sites);
  const auto lacks = std::count_if(sites.begin(), sites.end(), [&](const RecordSite& s) {
    return !records.covered(s.position, s.normal);
  });
  return static_cast<double>(lacks) / static_cast<double>(sites.size());
}

// Where something comes near, zones shrink: what they leave gets records, at every frame that is looked at.
TEST(FilmPlaces, ZonesThatShrinkLeaveNoHoles) {
  test::Slabs slabs;
  const int lands = slabs.slab("lands", 1, 0, 1.5f, 0);
  slabs.animate(lands, "translation", {0, 8, 16}, {0, 1.5f, 0, 0, 0.1f, 0, 0, 1.5f, 0});
  const std::string path = slabs.write("film-places", 17);
  FilmJob job;
  job.survey = survey(path, {}, {0, 16});
  FrameScenes scenes(path, {}, "");
  const Scene& first = scenes.at(0)->scene;
  RecordOptions& records = job.light.records;
  records.estimate = Estimate::gather, records.rays = 64, records.gather_bounces = 1;
  records.resolve(first.bounds.diagonal_m() / 4);
  job.placement.place = Place::view, job.placement.width = job.placement.height = 24;
  job.placement.min_radius_pixels = 0;
  resolve_film_places(job.placement, first, records.accuracy);
  Counters counters;
  const FilmChains made = make_chains(job, scenes, nullptr, counters);
  const Film film = film_of(made.chains, info_of(job), Quantity::indirect);
  for (const std::int64_t frame : {0, 4, 8, 12, 16})
    EXPECT_LT(ill_served(*scenes.at(frame), film), 0.01) << frame;
}

}  // namespace
}  // namespace phos
