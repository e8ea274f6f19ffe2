#include "splat/picture/report.h"

#include <algorithm>
#include <cmath>

#include "splat/limits.h"

namespace phos::inline splat {
namespace {

void put_stats(Tool& tool, const Rendering& rendering, const PictureGloss& gloss) {
  for (const auto& [part, seconds] : rendering.seconds.as_object()) tool.stat("seconds." + part, seconds);
  tool.stat("renderer", rendering.renderer);
  tool.stat("cache lookups", rendering.looked_up);
  tool.stat("cache misses", rendering.missed);
  if (rendering.edge_pixels > 0) tool.stat("edge pixels", rendering.edge_pixels);
  if (!gloss.report.as_array().empty()) tool.stat("gloss", gloss.report);
  if (gloss.cache) {
    tool.stat("gloss records", gloss.cache->size());
    tool.stat("gloss lookups", rendering.gloss.looked_up);
    tool.stat("gloss misses", rendering.gloss.missed);
    tool.stat("gloss pairs", rendering.gloss.pairs);
    tool.stat("gloss pixels of turned records", rendering.gloss.turned_pixels);
  }
  tool.counters().merge(rendering.counters);
}

std::string percent(std::uint64_t part, std::uint64_t all) {
  const double share = static_cast<double>(part) / static_cast<double>(all);
  return shortest(std::ceil(1e4 * share) / 100) + " %";
}

void tell_of_misses(const Tool& tool, const Rendering& r, const std::string& path) {
  if (!path.empty()) {
    tool.say(text(path, ": ", r.misses.size(), " points without a record"));
  } else if (r.missed > 0) {
    tool.warn(
        text(percent(r.missed, r.looked_up),
             " of the visible points have no record near enough (farther records light them); write these "
             "points with --misses and fill them with phos-irradiance --at, or raise --accuracy"));
  }
}

void tell_of_gloss_misses(const Tool& tool, const Rendering& r, const std::string& path) {
  if (!path.empty()) {
    tool.say(text(path, ": ", r.gloss_misses.size(), " glossy points without a radiance record"));
  } else if (r.gloss.missed > 0) {
    tool.warn(text(percent(r.gloss.missed, r.gloss.looked_up),
                   " of the glossy points have no radiance record near enough (their reflections are "
                   "traced); write these points with --gloss-misses and fill them with phos-radiance --at"));
  }
}

void tell_of_records(Tool& tool, const RenderOptions& render, const Rendering& rendering) {
  if (render.overlay == Overlay::none) return;
  const DrawnRecords& drawn = rendering.drawn;
  tool.stat("overlay.records", drawn.count);
  tool.stat("overlay.least", drawn.least);
  tool.stat("overlay.most", drawn.most);
  const OverlayColourRow& row = row_of(render.overlay_colour);
  const auto value = [&](double v) {
    return text(shortest(static_cast<float>(row.per_unit * v)), " ", row.unit);
  };
  tool.say(text(drawn.count, " records drawn; ", row.title, " from ", value(drawn.least), " (", row.least,
                ") to ", value(drawn.most), " (", row.most, "), logarithmic"));
}

}  // namespace

void report_picture(Tool& tool, const RenderOptions& render, const Rendering& rendering,
                    const PictureGloss& gloss, const std::string& misses, const std::string& gloss_misses) {
  put_stats(tool, rendering, gloss);
  tell_of_misses(tool, rendering, misses);
  if (gloss.cache || !gloss_misses.empty()) tell_of_gloss_misses(tool, rendering, gloss_misses);
  tell_of_records(tool, render, rendering);
}

void report_noise(Tool& tool, const RenderOptions& render, const NoiseTarget& target) {
  if (!render.noise) return;
  tool.stat("pilot noise, direct", target.direct);
  tool.stat("pilot noise, gloss", target.gloss);
  const auto sent = [&](const std::vector<std::uint8_t>& doublings, std::int64_t rays, const char* name) {
    if (doublings.empty()) return text(rays);
    double sum = 0;
    for (const std::uint8_t d : doublings) sum += std::exp2(d);
    const std::int64_t most = rays << *std::max_element(doublings.begin(), doublings.end());
    const auto mean = std::llround(static_cast<double>(rays) * sum / static_cast<double>(doublings.size()));
    tool.stat(name, mean);
    return text(rays, " to ", most, " (on average ", mean, ")");
  };
  tool.say(text(sent(target.doublings.direct, render.light_samples, "mean light samples"),
                " shadow rays a pixel and light and ",
                sent(target.doublings.gloss, render.gloss_samples, "mean gloss samples"),
                " rays of gloss are sent"));
  if (!target.enough)
    tool.warn(text("the noise asked for takes more than ", kMostNoiseRays.most,
                   " rays in parts of the picture; so many are sent"));
}

}  // namespace phos::inline splat
