#include "sense/daylight_factor.h"

#include "core/error.h"
#include "scene/sky/environment.h"

namespace phos::inline sense {
namespace {

struct Share {
  const char *of, *name, *said;
};
constexpr Share kShares[] = {{"mean_lx", "daylight_factor_mean_percent", "daylight factor: mean "},
                             {"min_lx", "daylight_factor_min_percent", " %, min "},
                             {"max_lx", "daylight_factor_max_percent", " %, max "}};

}  // namespace

double open_sky_lx(const Scene& scene) {
  const auto fail = [](const std::string& message) {
    return Error(ExitCode::usage, "--daylight-factor", message);
  };
  if (!scene.environment) throw fail("needs a sky; give --sky overcast, or --environment");
  if (scene.environment->sun())
    throw fail(
        "counts the light of the sky alone, and a sun shines too; leave out the sun, or give "
        "--sun-illuminance 0 if the sky needs the sun's position");
  for (const Light& light : scene.light)
    if (light.kind != Light::Kind::environment)
      throw fail(text("counts the light of the sky alone, and light \"", light.name,
                      "\" of the scene shines too; take it out"));
  const auto lx = static_cast<double>(luminance(Rgb(scene.environment->irradiance_up_lx())));
  if (!(lx > 0))
    throw fail("is a share of the illuminance in the open, and this sky gives none; give --sky overcast");
  return lx;
}

void add_daylight_factors(Json& summary, double open_lx) {
  summary["open_sky_lx"] = static_cast<float>(open_lx);
  for (const Share& share : kShares)
    if (const Json* lx = summary.find(share.of))
      summary[share.name] = static_cast<float>(100 * lx->as_number() / open_lx);
}

std::string daylight_line(const Json& summary) {
  if (!summary.find(kShares[0].name)) return "";
  std::string line;
  for (const Share& share : kShares) line += share.said + summary.find(share.name)->dump();
  line += " %";
  if (const Json* even = summary.find("U0")) line += ", U0 " + even->dump();
  return line + text(", of ", summary.find("open_sky_lx")->dump(), " lx in the open");
}

}  // namespace phos::inline sense
