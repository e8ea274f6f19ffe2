#include "temporal/chain.h"

#include <algorithm>

#include "core/error.h"
#include "radiance/cache.h"
#include "temporal/change.h"

namespace phos::inline temporal {
namespace {

void scale_gradients(Key& key, float factor) {
  for (Vec3& g : key.record.translation_gradient) g *= factor;
  if (!key.radiance) return;
  auto scaled = std::make_shared<RadianceRecord>(*key.radiance);
  for (float& g : scaled->gradient_x) g *= factor;
  for (float& g : scaled->gradient_y) g *= factor;
  key.radiance = std::move(scaled);
}

FilmRecord record_of(const Key& key) { return {key.record, {}, {}}; }
FilmRadianceRecord radiance_record_of(const Key& key) {
  PHOS_CHECK(key.radiance, "a chain of irradiance among those of radiance");
  FilmRadianceRecord r{*key.radiance, {}, {}};
  r.record.radius_m = key.record.radius_m;
  return r;
}

double rate_between(const Key& from, const Key& to) {
  const double frames = static_cast<double>(to.frame - from.frame);
  const double floor = 1e-6 * static_cast<double>(std::max(max_component(to.record.irradiance), 1e-30f));
  return change_rate(from.record.irradiance, to.record.irradiance, floor) / frames;
}

/// The key one frame on, as it was expected.
std::optional<Key> expected(const Key& key) {
  if (!key.ahead) return std::nullopt;
  return Key{key.frame + 1, key.frame + 1, key.ahead->record, key.ahead->radiance, key.ahead_pose};
}

template <class Record, class Make>
std::vector<Record> records_of(std::span<const Chain> chains, const FilmInfo& info, const Make& make) {
  std::vector<Record> records;
  for (const Chain& chain : chains) {
    const auto with_life = [&](const Key& k) {
      Record r = make(k);
      r.life.birth = static_cast<std::int32_t>(k.frame), r.life.end = static_cast<std::int32_t>(k.until);
      r.life.chain = chain.number, r.life.anchor = chain.anchor, r.life.turn = k.pose.turn;
      return r;
    };
    for (std::size_t i = 0; i < chain.keys.size(); ++i) {
      const Key& key = chain.keys[i];
      if (key.until <= key.frame) continue;
      Record record = with_life(key);
      const Key* next =
          i + 1 < chain.keys.size() && chain.keys[i + 1].frame == key.until ? &chain.keys[i + 1] : nullptr;
      record.life.rate = static_cast<float>(next && !key.ahead ? rate_between(key, *next) : key.rate);
      if (info.gradients == TemporalGradients::interpolated && next && !key.jumps) {
        record.change = change_between(record, with_life(*next));
      } else if (info.gradients == TemporalGradients::extrapolated) {
        if (const std::optional<Key> then = expected(key)) {
          record.change = change_between(record, with_life(*then), Reach::stays);
        }
      }
      records.push_back(std::move(record));
    }
  }
  std::stable_sort(records.begin(), records.end(),
                   [](const Record& a, const Record& b) { return a.life.chain < b.life.chain; });
  return records;
}

}  // namespace

const Key* Chain::at(std::int64_t frame) const {
  const auto found = std::lower_bound(keys.begin(), keys.end(), frame,
                                      [](const Key& k, std::int64_t f) { return k.frame < f; });
  return found != keys.end() && found->frame == frame ? &*found : nullptr;
}

std::optional<RecordSite> site_of(const Chain& chain, const Scene& scene, Pose& pose) {
  const Key& first = chain.keys.front();
  RecordSite site{first.record.position, first.record.normal, kFilmItems + chain.number};
  site.least_radius_m = chain.least_radius_m, site.most_radius_m = chain.most_radius_m;
  if (chain.anchor.triangle == kNoTriangle) return site;
  const std::optional<Pose> now = pose_of(scene, chain.anchor);
  if (!now) return std::nullopt;
  pose = *now;
  const bool moved = pose.position != first.pose.position || pose.turn != first.pose.turn;
  if (moved) {
    site.position = pose.position + turned(first.pose, pose, first.record.position - first.pose.position);
    site.normal = glm::normalize(turned(first.pose, pose, first.record.normal));
  }
  return site;
}

bool add_as_it_was(const Chain& chain, const Scene& scene, IrradianceCache& to) {
  Pose pose;
  const std::optional<RecordSite> site = site_of(chain, scene, pose);
  if (!site) return false;
  to.records.push_back(chain.keys.back().record);
  IrradianceRecord& record = to.records.back();
  record.position = site->position, record.normal = site->normal;
  if (record.footprint && chain.anchor.triangle != kNoTriangle)
    record.footprint = std::make_shared<AdaptiveFootprint>(record.footprint->moved_to(
        turned(chain.keys.back().pose, pose, record.footprint->x()), record.normal));
  return true;
}

Key key_of(const Chain& chain, const Made& made, const RadiusBounds& bounds, std::int64_t frame,
           const RecordSite& site, const Pose& pose) {
  Key key{frame, frame, made.record, made.radiance, pose};
  if (!made.radiance && key.record.position != site.position) {
    key.record.irradiance = extrapolate(made.record, site.position, made.record.normal);
    key.record.position = site.position;
  }
  const float raw = made.record.radius_m * chain.share;
  if (made.record.footprint) {  // has looked in bounds: its share alone can take it below them
    key.record.radius_m = std::min(made.record.radius_m, std::max(raw, least_radius_m(bounds, made.record)));
    return key;
  }
  key.record.radius_m = within_bounds_m(raw, made, bounds);
  if (raw < key.record.radius_m) scale_gradients(key, raw / key.record.radius_m);
  return key;
}

Chain chain_of(const Made& made, const IrradianceRecord& settled, const RadianceRecord* radiance,
               const RayScene& rays, std::int64_t frame, const FilmSurvey& survey) {
  Chain chain;
  chain.number = static_cast<std::uint32_t>(made.item - kFilmItems);
  chain.share = std::min(1.f, settled.radius_m / made.record.radius_m);
  chain.least_radius_m = made.site_least_m, chain.most_radius_m = made.site_most_m;
  Pose pose;
  const Anchor anchor = anchor_at(rays, settled.position, settled.normal);
  if (anchor.triangle != kNoTriangle && survey.moved[rays.scene().triangle_instance[anchor.triangle]]) {
    chain.anchor = anchor;
    if (const std::optional<Pose> now = pose_of(rays.scene(), anchor)) pose = *now;
  }
  chain.keys.push_back(
      {frame, frame, settled, radiance ? std::make_shared<const RadianceRecord>(*radiance) : nullptr, pose});
  return chain;
}

Film film_of(std::span<const Chain> chains, const FilmInfo& info, Quantity quantity) {
  return {info, quantity, records_of<FilmRecord>(chains, info, record_of)};
}
RadianceFilm radiance_film_of(std::span<const Chain> chains, const FilmInfo& info) {
  return {info, records_of<FilmRadianceRecord>(chains, info, radiance_record_of)};
}

}  // namespace phos::inline temporal
