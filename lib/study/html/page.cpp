#include "study/html/page.h"

#include "core/error.h"
#include "core/options.h"
#include "core/text/markup.h"
#include "study/html/assets.h"
#include "study/html/pictures.h"
#include "study/html/text.h"

namespace phos::inline study {

namespace {

using Kind = std::optional<Summary> PointResult::*;

std::string view_title(const StudyFile& study, std::size_t view) {
  const std::string& scene = study.scenes[view / study.cameras.size()];
  const std::string& camera = study.cameras[view % study.cameras.size()];
  return scene.substr(scene.rfind('/') + 1) + (camera.empty() ? "" : text(", camera ", camera));
}

bool several_views(const PageInput& in) { return in.study.scenes.size() * in.study.cameras.size() > 1; }

std::string plots(const PageInput& in, const std::string& part) {
  std::string html;
  for (const NamedPlot& p : in.plots)
    if (p.name.find(part) != std::string::npos)
      html += text("<img alt=\"", markup_text(p.title), "\" src=\"", svg_uri(plot_svg(p.plot)), "\">");
  return html.empty() ? "" : "<div class=\"plots\">" + html + "</div>\n";
}

std::string heads(const PageInput& in, const std::string& unit) {
  std::string html = "<thead><tr><th>point</th>";
  if (several_views(in)) html += "<th>scene, camera</th>";
  for (const Factor& f : in.study.factors) html += text("<th>", markup_text(f.name()), "</th>");
  for (const std::string& name :
       {std::string("error, %"), std::string("bias, %"), std::string("99th percentile, %"),
        text("RMS, ", unit), std::string("stated, %"), std::string("within 2 s.e., %"),
        std::string("reference resolves, %"), std::string("time, s"), std::string("CPU, s"),
        std::string("memory"), std::string("files"), std::string("front"), std::string("commands")})
    html += text("<th>", markup_text(name), "</th>");
  return html + "</tr></thead>\n";
}

std::string fronts(const Summary& s) {
  std::string words;
  for (const auto& [best, name] :
       {std::pair{s.best_in_time, "time"}, {s.best_in_memory, "memory"}, {s.best_in_bytes, "files"}})
    if (best) words.append(words.empty() ? "" : ", ").append(name);
  return words;
}

std::string commands(const PageInput& in, std::size_t setting, std::optional<std::size_t> Job::*last) {
  for (const Job& job : in.work.jobs) {
    if (job.setting != setting || !(job.*last)) continue;
    std::string lines;
    for (const std::string& line : in.work.stages.shell_lines(*(job.*last), text("p", setting)))
      lines.append(line).append("\n");
    return text("<details><summary>show</summary><pre>", markup_text(lines), "</pre></details>");
  }
  return "";
}

std::string row(const PageInput& in, const PointResult& p, const Summary& s,
                std::optional<std::size_t> Job::*last) {
  const Setting& setting = in.work.settings[p.setting];
  std::string html = text(s.best_in_time ? "<tr class=\"front\">" : "<tr>", "<td>", p.setting, "</td>");
  const std::size_t view = setting.scene * in.study.cameras.size() + setting.camera;
  if (several_views(in)) html += text("<td>", markup_text(view_title(in.study, view)), "</td>");
  for (std::size_t i = 0; i < in.study.factors.size(); ++i)
    html += text("<td>", markup_text(in.study.factors[i].labels[setting.level[i]]), "</td>");
  const auto percent = [](const std::optional<double>& v) {
    return number_cell(v.value_or(NAN), v ? short_number(100 * *v) : "-");
  };
  html += number_cell(s.error.mean, interval_text(s.error, 100) + (s.resolved ? "" : " not told from 0"));
  html += number_cell(s.bias.mean, interval_text(s.bias, 100)) +
          number_cell(s.p99.mean, interval_text(s.p99, 100));
  html += number_cell(s.rmse, short_number(s.rmse)) + percent(s.stated) + percent(s.inside) +
          percent(s.resolution);
  html += number_cell(s.seconds.mean, interval_text(s.seconds)) +
          number_cell(s.cpu_s.mean, short_number(s.cpu_s.mean));
  html += number_cell(s.peak_bytes, bytes_text(s.peak_bytes)) +
          number_cell(s.file_bytes, bytes_text(s.file_bytes));
  html += text("<td>", fronts(s), "</td><td>", commands(in, p.setting, last), "</td></tr>\n");
  return html;
}

std::string table(const PageInput& in, Kind kind, std::optional<std::size_t> Job::*last) {
  std::string rows, unit, failed;
  for (const PointResult& p : in.results.points) {
    if (const Summary* s = p.own(kind)) unit = s->unit, rows += row(in, p, *s, last);
    if (!(p.*kind) && !p.failed.empty())
      failed += text("<p class=\"doubt\">point ", p.setting, " (",
                     markup_text(describe(in.study, in.work.settings[p.setting])),
                     ") failed: ", markup_text(p.failed), "</p>\n");
  }
  return text("<div class=\"scroll\"><table class=\"sorts\">", heads(in, unit), "<tbody>\n", rows,
              "</tbody></table></div>\n", failed);
}

std::string effects(const PageInput& in, const std::vector<FactorEffect>& all) {
  if (all.empty()) return "";
  std::string html =
      "<h3>What each parameter buys</h3><div "
      "class=\"scroll\"><table><thead><tr><th>parameter</th><th>value</th><th>error, times that of the first "
      "value</th><th>time, times that of the first value</th><th>pairs</th><th>of them with errors that the "
      "reference cannot tell</th></tr></thead><tbody>\n";
  for (const FactorEffect& e : all)
    for (std::size_t i = 0; i < e.levels.size(); ++i) {
      const Factor& f = in.study.factors[e.factor];
      const LevelEffect& l = e.levels[i];
      html += text("<tr><td>", i == 0 ? markup_text(f.name()) : "", "</td><td>", markup_text(f.labels[i]),
                   "</td><td>", i == 0 ? "1" : interval_text(l.error), "</td><td>",
                   i == 0 ? "1" : interval_text(l.seconds), "</td><td>", l.pairs, "</td><td>", l.faint,
                   "</td></tr>\n");
    }
  return html + "</tbody></table></div>\n";
}

std::string head(const PageInput& in) {
  const StudyFile& s = in.study;
  std::string html = text(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>",
      markup_text(s.path), "</title><style>", kPageStyle, "</style></head><body>\n<h1>", markup_text(s.path),
      "</h1>\n");
  html +=
      text("<p>", in.work.settings.size(), in.work.settings.size() == 1 ? " setting, " : " settings, ",
           s.seeds.size(), s.seeds.size() == 1 ? " seed; phos " : " seeds each; phos ", version(),
           ". Errors are root mean square differences from the reference, divided by its mean, without the "
           "reference's own noise",
           s.ignore_lamps ? "; pixels of lamps are left out" : "", ". Brackets hold intervals of ",
           short_number(100 * s.confidence),
           " %: Student's t over seeds, and what the reference itself is uncertain of. A ratio of two values "
           "is over settings that differ in nothing else. Time is that of all stages from the scene to the "
           "result, each once",
           s.by_cpu ? "; fronts, plots and ratios are of processor time" : "",
           s.threads > 0 ? text(", on ", s.threads, s.threads == 1 ? " thread" : " threads") : "", ".</p>\n");
  for (const std::string& sentence : doubts(in.results))
    html += text("<p class=\"doubt\">", markup_text(sentence), "</p>\n");
  return html;
}

}  // namespace

std::string study_page(const PageInput& in) {
  std::string html = head(in);
  if (in.study.makes_pictures()) {
    html += text("<h2>Pictures: ", markup_text(in.study.layer), "</h2>\n");
    html += plots(in, "picture-error-") + table(in, &PointResult::picture, &Job::picture);
    html += effects(in, in.results.picture_effects) + plots(in, "picture-effect-");
    for (std::size_t v = 0; v < in.work.pictures.size(); ++v)
      if (const std::string pictures = pictures_section(in, v); !pictures.empty())
        html += text("<h2>", markup_text(view_title(in.study, v)), "</h2>\n", pictures);
  }
  if (in.study.reads_sensors()) {
    html += text("<h2>Illuminance at ", markup_text(in.study.sensors.substr(in.study.sensors.rfind('/') + 1)),
                 "</h2>\n");
    html += plots(in, "lux-error-") + table(in, &PointResult::lux, &Job::lux);
    html += effects(in, in.results.lux_effects) + plots(in, "lux-effect-");
  }
  return html + "<script>" + kPageScript + "</script></body></html>\n";
}

}  // namespace phos::inline study
