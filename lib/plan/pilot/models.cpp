#include "plan/pilot/models.h"

#include <algorithm>
#include <cmath>

#include "file/csv.h"
#include "plan/calibration.h"
#include "record/irradiance_cache.h"

namespace phos::inline plan {
namespace {

using K = Knob;

Posynomial sum_of(std::vector<Monomial> terms) { return Posynomial(std::move(terms)); }

/// What the coarse cache blurs near edges and contacts: a strip as wide as its zones.
const Monomial kZoneBlur{"blur of photons' zones", {{K::photons, calibration::kZoneBlurPhotons}}};
const Monomial kInterpolation{"interpolation between records", {{K::accuracy, 2}}};
std::pair<Knob, double> blended(const PlanTask& task) {
  return {K::read, task.adaptive_zones() ? calibration::kAdaptiveNoiseRead : calibration::kNoiseRead};
}
const Monomial kPhotonNoise{"noise of photons", {{K::photons, -1}}};
/// Of records of photons alone: a zone that has as many as it may hold has no more where there are more.
const Monomial kZoneNoise{"noise of full zones", {{K::photons, calibration::kFullZonePhotons}}};
constexpr const char* kTextures = "textures and shadows within pixels";
const Monomial kUnmended{"what no setting mends", {}};

}  // namespace

double RecordCount::at(double a) const {
  if (!(count > 0)) return 0;
  const double odds = count / (most - count) * std::pow(a / accuracy, -power);
  return most * odds / (1 + odds);
}

RecordCount count_of(double a, double n, double finer, double more, double most) {
  RecordCount count{n, a, 0, std::max(most, calibration::kRecordRoom * std::max(n, more))};
  const auto odds = [&](double records) { return records / (count.most - records); };
  if (n > 0 && more > n) count.power = std::log(odds(more) / odds(n)) / std::log(a / finer);
  return count;
}

double records_read(double a) { return std::pow(reading_accuracy(a) / a, 2); }

double ReferenceCost::resolution(double samples) const {
  // Two references of variance v each: the mean over n places of the product of their errors deviates by v /
  // sqrt(n).
  return std::sqrt(2 * variance / samples / std::sqrt(std::max(places, 1.0)));
}

double ReferenceCost::samples(double resolution) const {
  return 2 * variance / (resolution * resolution) / std::sqrt(std::max(places, 1.0));
}

PlanModel image_error_model(const PlanTask& task, double detail) {
  // Samples at edges share the rays of their pixel: the part of each falls with the square of its own few,
  // its share of the pixel with the number of samples. Points that gloss rays find on lamps: even ones, under
  // an edge, whose mean varies as n^-1.5. Where a surface curves, each sample of a pixel sees that edge
  // elsewhere, and its few rays find it as independent ones do. Half shadows may be narrower than a pixel of
  // the pilot.
  const std::pair<Knob, double> narrow{K::pixels, calibration::kShadowNoisePixels};
  std::vector<Monomial> direct = {
      {"noise of shadow rays", {narrow, {K::light_rays, -1}}},
      {"noise of shadow rays, fast part", {narrow, {K::light_rays, -2}}},
      {"noise of shadow rays at edges", {{K::light_rays, -2}, {K::edge_samples, 1}, {K::pixels, -0.5}}}};
  std::vector<Monomial> gloss;
  if (task.gloss) {
    direct.push_back({"noise of lamps that gloss rays find", {{K::gloss_rays, -1.5}}});
    direct.push_back({"noise of lamps that gloss rays find, curved surfaces",
                      {{K::gloss_rays, -1}, {K::pixel_samples, calibration::kCurvedGlossSamples}}});
    gloss = {{"noise of gloss rays", {{K::gloss_rays, -1}}},
             {"noise of edges in gloss", {{K::gloss_rays, -1.5}}},
             {"noise of lamps in gloss", {{K::light_rays, -1}, {K::gloss_rays, -1}}},
             {"noise of records seen in gloss", {blended(task), {K::rays, -1}}}};
  }
  if (task.specular) gloss.push_back({"noise of mirrors and glass", {{K::pixel_samples, -1}}});
  std::vector<Monomial> indirect = {{"noise of gathered rays", {blended(task), {K::rays, -1}}},
                                    {"noise of gathered rays, fast part", {blended(task), {K::rays, -1.5}}},
                                    kPhotonNoise};
  if (task.by_photons) indirect = {kPhotonNoise, kZoneNoise};
  const Monomial edges{"edges within pixels", {{K::edge_samples, -1}, {K::pixels, -0.5}}},
      // Finer pixels show more of a texture.
      textures{kTextures, {{K::pixel_samples, -1}, {K::pixels, -detail}}},
      blur{"shadows that pixels share", {{K::light_rays, -1}, {K::pixels, -0.5}}};
  PlanModel model{
      {{"direct light, noise", sum_of(direct)},
       {"direct light and gloss, bias", sum_of({edges, textures, blur})},
       {"indirect light, noise", sum_of(indirect)},
       {"indirect light, bias", sum_of({edges, textures, kInterpolation, kZoneBlur, kUnmended})}}};
  if (!gloss.empty()) model.part.emplace_back("gloss, noise", sum_of(gloss));
  return model;
}

void add_missed_detail(PlanModel& image_error, double detail, double sampled, double growth) {
  const double missed = std::pow(growth, detail - std::clamp(sampled, 0.0, detail)) - 1;
  if (!(missed > 0)) return;
  for (auto& [name, p] : image_error.part)
    p.extend(kTextures, {"textures within pixels, fast part", {{K::pixel_samples, -2}, {K::pixels, -detail}}},
             missed);
}

PlanModel lux_error_model(const PlanTask& task) {
  // Each sensor has a record, and reads its neighbours' too: as many as lie within the accuracy that it reads
  // at, whose square read x accuracy^2 is.
  const auto reading = [](double power) {
    return std::vector<std::pair<Knob, double>>{{K::read, power}, {K::accuracy, 2 * power}};
  };
  const auto rays = [&](double power) {
    std::vector<std::pair<Knob, double>> powers = reading(calibration::kSensorNoiseReading);
    powers.emplace_back(K::rays, power);
    return powers;
  };
  std::vector<Monomial> indirect = {
      {"noise of gathered rays", rays(-1)}, {"noise of gathered rays, fast part", rays(-1.5)}, kPhotonNoise};
  if (task.by_photons) indirect = {kPhotonNoise, kZoneNoise};
  return {{{"direct light, noise", sum_of({{"noise of shadow rays", {{K::sensor_rays, -1}}}})},
           {"direct light, bias", sum_of({kUnmended})},
           {"indirect light, noise", sum_of(indirect)},
           {"indirect light, bias",
            sum_of({{"interpolation between records", reading(1)}, kZoneBlur, kUnmended})}}};
}

PlanModel time_model(const PlanTask& task) {
  PlanModel model;
  std::vector<Monomial> records = {
      {"start", {}}, {"places", {{K::pixels, 1}}}, {"records", {{K::records, 1}}}};
  if (!task.by_photons) records.push_back({"their rays", {{K::records, 1}, {K::rays, 1}}});
  model.part = {
      {"photons", sum_of({{"start", {}}, {"photons", {{K::photons, 1}}}})},
      {"coarse records",
       sum_of({{"start", {}}, {"coarse records", {{K::photons, calibration::kCoarseSecondsPhotons}}}})},
      {"records", sum_of(records)}};
  if (task.cached_gloss) {
    std::vector<Monomial> gloss = {
        {"start", {}}, {"places", {{K::pixels, 1}}}, {"radiance records", {{K::gloss_records, 1}}}};
    if (!task.by_photons)
      gloss.push_back({"rays of radiance records", {{K::gloss_records, 1}, {K::rays, 1}}});
    model.part.emplace_back("lobes", sum_of({{"start", {}}}));
    model.part.emplace_back("coarse records, for gloss", *std::as_const(model).find("coarse records"));
    model.part.emplace_back("gloss records", sum_of(gloss));
  }
  if (task.image) {
    std::vector<Monomial> terms = {
        {"start", {}},
        {"pixels", {{K::pixels, 1}}},
        {"scene, drawn for each pixel sample", {{K::pixel_samples, 1}}},
        {"pixel samples", {{K::pixels, 1}, {K::pixel_samples, 1}}},
        {"edges", {{K::pixels, calibration::kEdgeSecondsPixels}, {K::edge_samples, 1}}},
        {"shadow rays", {{K::pixels, 1}, {K::light_rays, 1}}}};
    if (task.gloss) terms.push_back({"gloss rays", {{K::pixels, 1}, {K::gloss_rays, 1}}});
    model.part.emplace_back("picture", sum_of(terms));
  }
  if (task.image && task.lux)  // made anew when records for the sensors are added
    model.part.emplace_back("coarse records, again", *std::as_const(model).find("coarse records"));
  if (task.lux)
    model.part.emplace_back("lux", sum_of({{"start", {}}, {"shadow rays", {{K::sensor_rays, 1}}}}));
  return model;
}

std::string thinned_rows(const std::string& csv, const std::string& where,
                         const std::vector<std::string>& columns, std::size_t most, std::size_t* rows) {
  const CsvTable table = parse_csv(csv, where);
  std::vector<std::size_t> kept;
  std::string out;
  for (const std::string& name : columns) {
    kept.push_back(table.column(name, where));
    out.append(out.empty() ? "" : ",").append(name);
  }
  out += '\n';
  const std::size_t n = table.rows.size(), count = std::min(n, most);
  if (rows) *rows = n;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<std::string>& row = table.rows[count > 1 ? i * (n - 1) / (count - 1) : 0];
    for (std::size_t c = 0; c < kept.size(); ++c) out.append(c > 0 ? "," : "").append(row[kept[c]]);
    out += '\n';
  }
  return out;
}

}  // namespace phos::inline plan
