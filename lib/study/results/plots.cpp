#include "study/results/plots.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "core/error.h"

namespace phos::inline study {

namespace {

using Kind = std::optional<Summary> PointResult::*;

struct Axis {
  const char *name, *label;
  std::function<double(const Summary&)> cost;
  bool Summary::*best;
};

const std::vector<Axis>& axes() {
  static const std::vector<Axis> all{
      {"time", "time of all stages, s", [](const Summary& s) { return s.time.mean; }, &Summary::best_in_time},
      {"memory", "largest memory of a stage, MiB", [](const Summary& s) { return s.peak_bytes / 1048576; },
       &Summary::best_in_memory},
      {"bytes", "files between scene and result, MiB",
       [](const Summary& s) { return s.file_bytes / 1048576; }, &Summary::best_in_bytes}};
  return all;
}

/// "12.5" of "12.5", nothing of a word.
std::optional<double> number_of(const std::string& word) {
  char* end = nullptr;
  const double v = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0' && std::isfinite(v) ? std::optional(v) : std::nullopt;
}

/// The factor whose values the series of a plot stand for: the first with few enough.
std::optional<std::size_t> factor_of_series(const StudyFile& study) {
  constexpr std::size_t kMost = 7;  // colours that are told apart, and one for the front
  for (std::size_t f = 0; f < study.factors.size(); ++f)
    if (study.factors[f].labels.size() <= kMost) return f;
  return std::nullopt;
}

bool some_shows(const Plot& plot) {
  std::size_t all = 0;
  for (const PlotLine& line : plot.lines) all += line.points.size();
  return points_left_out(plot) < all;
}

/// A view of a study: its scene and camera, and the points there.
struct View {
  std::string suffix, title;
  std::vector<const PointResult*> points;
};

std::vector<View> views_of(const StudyFile& study, const StudyWork& work, const StudyResults& results) {
  std::vector<View> views(study.scenes.size() * study.cameras.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::string& scene = study.scenes[v / study.cameras.size()];
    const std::string& camera = study.cameras[v % study.cameras.size()];
    if (views.size() > 1) views[v].suffix = text("-", v);
    views[v].title = scene.substr(scene.rfind('/') + 1) + (camera.empty() ? "" : text(", ", camera));
  }
  for (const PointResult& p : results.points) {
    const Setting& s = work.settings[p.setting];
    views[s.scene * study.cameras.size() + s.camera].points.push_back(&p);
  }
  return views;
}

Plot trade_of(const StudyFile& study, const StudyWork& work, const View& view, Kind kind, const Axis& axis) {
  Plot plot;
  plot.x = {axis.label, Scale::logarithmic, {}, {}};
  plot.y = {"error (RMS / mean)", Scale::logarithmic, {}, {}};
  PlotLine front{"front", {}, true, {}};
  const std::optional<std::size_t> series = factor_of_series(study);
  std::vector<PlotLine> lines(series ? study.factors[*series].labels.size() : 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (series) lines[i].name = text(study.factors[*series].option, " ", study.factors[*series].labels[i]);
    lines[i].joined = false;
  }
  for (const PointResult* p : view.points) {
    if (!p->own(kind)) continue;
    const Summary& s = *p->own(kind);
    PlotLine& line = lines[series ? work.settings[p->setting].level[*series] : 0];
    line.points.push_back({axis.cost(s), s.told_error()});
    // A bar that reaches for 0 begins at the axis, instead of stretching it.
    constexpr double kFar = 10;
    if (s.error.bounded())
      line.bars.push_back({axis.cost(s), s.error.lo * kFar < s.told_error() ? 0 : s.error.lo, s.error.hi});
    if (s.*axis.best) front.points.push_back({axis.cost(s), s.told_error()});
  }
  std::sort(front.points.begin(), front.points.end(),
            [](const PlotPoint& a, const PlotPoint& b) { return a.x != b.x ? a.x < b.x : a.y > b.y; });
  plot.lines.push_back(std::move(front));  // under the marks
  for (PlotLine& line : lines) plot.lines.push_back(std::move(line));
  return plot;
}

/// Ratios of error and time by the values of a factor of numbers.
std::optional<Plot> effect_of(const StudyFile& study, const FactorEffect& effect) {
  const Factor& factor = study.factors[effect.factor];
  Plot plot;
  plot.y = {text("against ", factor.option, " = ", factor.labels[0]), Scale::logarithmic, {}, {}};
  PlotLine error{"error", {}, true, {}}, time{"time", {}, true, {}};
  double least = INFINITY, most = 0;
  for (std::size_t i = 0; i < factor.labels.size(); ++i) {
    const std::optional<double> x = number_of(factor.labels[i]);
    if (!x) return std::nullopt;
    least = std::min(least, *x), most = std::max(most, *x);
    const LevelEffect& level = effect.levels[i];
    error.points.push_back({*x, level.error.mean}), time.points.push_back({*x, level.seconds.mean});
    if (level.error.bounded()) error.bars.push_back({*x, level.error.lo, level.error.hi});
    if (level.seconds.bounded()) time.bars.push_back({*x, level.seconds.lo, level.seconds.hi});
  }
  const auto by_x = [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; };
  std::sort(error.points.begin(), error.points.end(), by_x),
      std::sort(time.points.begin(), time.points.end(), by_x);
  constexpr double kWide = 8;     // a range of values that equal steps would crowd
  constexpr double kRoom = 0.06;  // beside the outermost values, of the range
  plot.x.label = factor.name();
  if (least > 0 && most >= kWide * least) {
    const double room = std::pow(most / least, kRoom);
    plot.x.scale = Scale::logarithmic, plot.x.min = least / room, plot.x.max = most * room;
  } else {
    plot.x.min = least - kRoom * (most - least), plot.x.max = most + kRoom * (most - least);
  }
  plot.lines = {std::move(error), std::move(time)};
  return plot;
}

}  // namespace

std::vector<NamedPlot> plots_of(const StudyFile& study, const StudyWork& work, const StudyResults& results) {
  std::vector<NamedPlot> plots;
  const auto add = [&](const std::string& name, const std::string& title, Plot plot) {
    plot.title = title;
    if (some_shows(plot)) plots.push_back({name, title, std::move(plot)});
  };
  struct Named {
    const char* name;
    Kind kind;
    const std::vector<FactorEffect>* effects;
    bool there;
  };
  const Named kinds[] = {{"picture", &PointResult::picture, &results.picture_effects, study.makes_pictures()},
                         {"lux", &PointResult::lux, &results.lux_effects, study.reads_sensors()}};
  for (const Named& k : kinds) {
    if (!k.there) continue;
    for (const View& view : views_of(study, work, results))
      for (const Axis& axis : axes())
        add(text(k.name, "-error-", axis.name, view.suffix),
            text(k.name, ": error over ", axis.name, " - ", view.title),
            trade_of(study, work, view, k.kind, axis));
    for (const FactorEffect& effect : *k.effects)
      if (std::optional<Plot> plot = effect_of(study, effect))
        add(text(k.name, "-effect-", study.factors[effect.factor].section, "-",
                 study.factors[effect.factor].option),
            text(k.name, ": what ", study.factors[effect.factor].name(), " buys"), std::move(*plot));
  }
  return plots;
}

}  // namespace phos::inline study
