#include "scene/luminaire/goniometric.h"

#include <cstdio>

#include "core/error.h"

namespace phos::inline scene {
namespace {

PolarCurve curve(const Photometry& photometry, int c_deg) {
  constexpr int kSteps = 720;  // quarters of a degree
  PolarCurve out{text("C", c_deg, " - C", c_deg + 180), {}};
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double deg = 180.0 * k / kSteps;
    out.points.push_back({deg, photometry.candela(c_gamma_direction(c_deg, deg))});
  }
  return out;
}

}  // namespace

PolarPlot goniometric_plot(const PhotometricFile& file, const std::string& absent) {
  PolarPlot plot;
  plot.title = file.title(absent);
  plot.unit = "cd";
  plot.curves.push_back(curve(*file.photometry, 0));
  if (!file.photometry->rotational()) plot.curves.push_back(curve(*file.photometry, 90));
  const Json j = describe_photometry(file);
  const auto number = [&](const char* key) {
    char s[32];
    std::snprintf(s, sizeof s, "%.4g", j.find(key)->as_number());
    return std::string(s);
  };
  constexpr const char* kDegree = "\xc2\xb0";
  plot.caption.push_back(text(number("lumens"), " lm, maximum ", number("maximum_cd"), " cd at C ",
                              number("maximum_c_deg"), kDegree, ", gamma ", number("maximum_gamma_deg"),
                              kDegree));
  plot.caption.push_back(text("beam ", number("beam_c0_deg"), kDegree, " x ", number("beam_c90_deg"), kDegree,
                              ", field ", number("field_c0_deg"), kDegree, " x ", number("field_c90_deg"),
                              kDegree));
  plot.caption.push_back(text(j.find("opening")->as_string(), ", ", file.format));
  return plot;
}

}  // namespace phos::inline scene
