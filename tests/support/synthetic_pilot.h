// A pilot whose models are known, for the picture of a room.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plan/plan.h"

namespace phos::test {

inline Posynomial known(std::vector<Monomial> terms, std::vector<double> coefficients) {
  Posynomial p(std::move(terms));
  p.set(std::move(coefficients));
  return p;
}

using K = Knob;

inline PlanModel synthetic_time() {
  return {{{"photons", known({{"start", {}}, {"photons", {{K::photons, 1}}}}, {0.1, 2e-6})},
           {"records", known({{"rays", {{K::records, 1}, {K::rays, 1}}}}, {1e-6})},
           {"picture", known({{"samples", {{K::pixels, 1}, {K::pixel_samples, 1}}},
                              {"shadows", {{K::pixels, 1}, {K::light_rays, 1}}}},
                             {1e-6, 2e-7})}}};
}

inline PlanModel synthetic_error(double unmended) {
  return {
      {{"direct light and gloss, noise", known({{"shadow rays", {{K::light_rays, -1}}}}, {0.02})},
       {"direct light and gloss, bias", known({{"edges", {{K::pixel_samples, -1}, {K::pixels, -0.5}}}}, {2})},
       {"indirect light, noise",
        known({{"gathered rays", {{K::accuracy, 1}, {K::rays, -1}}}, {"photons", {{K::photons, -1}}}},
              {1, 20})},
       {"indirect light, bias",
        known({{"interpolation", {{K::accuracy, 2}}}, {"what no setting mends", {}}}, {0.002, unmended})}}};
}

inline Pilot synthetic_pilot(double unmended = 0) {
  Pilot pilot;
  pilot.time = synthetic_time();
  pilot.image_error = synthetic_error(unmended);
  pilot.records = {2000, 0.5, 1.5, 1e9};
  pilot.image_reference = {0.1, 1e-6, 1, 30000};
  return pilot;
}

inline PlanTask picture() {
  PlanTask task;
  task.scene = "a room.glb", task.width = 200, task.height = 150;
  return task;
}

/// All guesses of a part of a model.
inline void scale(Posynomial& p, double factor) {
  for (std::size_t guess = 0; guess <= Posynomial::kBest; ++guess) p.scale(guess, factor);
}

}  // namespace phos::test
