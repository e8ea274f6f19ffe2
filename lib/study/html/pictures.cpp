#include "study/html/pictures.h"

#include <algorithm>

#include "core/error.h"
#include "core/text/markup.h"
#include "image/false_colour.h"
#include "image/layer_picture.h"
#include "image/metrics.h"
#include "study/html/text.h"

namespace phos::inline study {

namespace {

struct Shown {
  std::string id, caption, picture, difference;  ///< data URIs
};

/// Points of a view with a picture, those on the front first, at most as many as asked for.
std::vector<std::size_t> chosen(const PageInput& in, std::size_t view) {
  std::vector<std::size_t> points;
  for (const bool best : {true, false})
    for (const PointResult& p : in.results.points) {
      const Setting& s = in.work.settings[p.setting];
      if (s.scene * in.study.cameras.size() + s.camera == view && p.own(&PointResult::picture) &&
          p.picture->best_in_time == best)
        points.push_back(p.setting);
    }
  points.resize(std::min(points.size(), in.pictures));
  std::sort(points.begin(), points.end());
  return points;
}

/// The picture of a point's first seed that has one, with its largest usual difference.
std::pair<std::string, double> file_of(const PageInput& in, std::size_t setting) {
  for (const RunResult& run : in.results.runs)
    if (run.setting == setting && run.picture)
      for (const Job& job : in.work.jobs)
        if (job.setting == setting && job.seed == run.seed)
          return {in.work.stages[*job.picture].command.output, run.picture->error.p99};
  return {};
}

double usual_difference(const PageInput& in, const std::vector<std::size_t>& points) {
  std::vector<double> all;
  for (const std::size_t p : points) all.push_back(file_of(in, p).second);
  const double middle = median(all);
  return middle > 0 ? round_up_125(middle) : 0;
}

std::vector<Shown> show(const PageInput& in, std::size_t view, const std::vector<std::size_t>& points) {
  const Image reference = read_image(in.work.pictures[view].files[0]);
  const std::string layer = layer_from_label(in.study.layer);
  LayerPictureOptions options;
  options.layer = in.study.layer;
  options = fixed_exposure(reference, options);
  const double range = usual_difference(in, points);
  std::vector<Shown> all{
      {text("v", view, "r"), "reference", data_uri(layer_picture(reference, options).picture), ""}};
  for (const std::size_t p : points) {
    const Image image = read_image(file_of(in, p).first);
    const bool lamps =
        in.study.ignore_lamps && (reference.has_layer("emission") || image.has_layer("emission"));
    const std::vector<float> d =
        layer_values(difference_image(image, reference, {{in.study.layer}, lamps}), layer);
    const Summary& s = *in.results.points[p].picture;
    all.push_back({text("v", view, "p", p),
                   text("point ", p, ": ", describe(in.study, in.work.settings[p]), "; error ",
                        short_number(100 * s.error.mean), " % in ", short_number(s.time.mean), " s"),
                   data_uri(layer_picture(image, options).picture),
                   data_uri(difference_picture(d, image.width(), image.height(), range, "difference",
                                               layer_unit(layer)))});
  }
  return all;
}

std::string choice(const std::vector<Shown>& all, std::size_t selected) {
  std::string html = "<select>";
  for (std::size_t i = 0; i < all.size(); ++i)
    html += text("<option value=\"", all[i].id, "\"", i == selected ? " selected" : "", ">",
                 markup_text(all[i].caption), "</option>");
  return html + "</select>";
}

}  // namespace

std::string pictures_section(const PageInput& in, std::size_t view) {
  const std::vector<std::size_t> points = chosen(in, view);
  if (points.empty()) return "";
  const std::vector<Shown> all = show(in, view, points);
  std::string html = "<div class=\"compare\">";
  html += text("Left: ", choice(all, 0), " Right: ", choice(all, 1));
  html += text(
      "<br><div class=\"stage\"><img alt=\"right picture\" src=\"", all[1].picture,
      "\"><img alt=\"left picture\" src=\"", all[0].picture,
      "\"><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"where the two meet\"></div>");
  html +=
      "<div class=\"pair\"><img alt=\"difference of the left one\" hidden><img alt=\"difference of the right "
      "one\" hidden></div></div>\n";
  html +=
      "<details><summary>All pictures, and what they differ by from the reference (blue: too dark, red: too "
      "bright)</summary><div class=\"gallery\">\n";
  for (const Shown& s : all) {
    html +=
        text("<figure><img id=\"", s.id, "\" alt=\"", markup_text(s.caption), "\" src=\"", s.picture, "\">");
    if (!s.difference.empty())
      html += text("<img id=\"", s.id, "d\" alt=\"difference\" src=\"", s.difference, "\">");
    html += text("<figcaption>", markup_text(s.caption), "</figcaption></figure>\n");
  }
  return html + "</div></details>\n";
}

}  // namespace phos::inline study
