#include "radiance/brdf/lamp_figure_options.h"

#include <algorithm>

#include "core/error.h"
#include "core/options/number.h"
#include "core/text/comma_list.h"
#include "hsh/limits.h"
#include "scene/limits.h"

namespace phos::inline radiance {

namespace {

constexpr const char* kSection = "Figure by one lamp";

DVec3 three_numbers(const std::string& option, const std::string& words) {
  const std::vector<std::string> items = split_at_commas(words);
  if (items.size() != 3)
    reject_option(option, text("\"", words, "\" is not three numbers; give X,Y,Z, such as 2,5,3"));
  DVec3 v(0);
  for (int i = 0; i < 3; ++i) v[i] = parse_number<double>(option, items[static_cast<std::size_t>(i)], {});
  return v;
}

}  // namespace

void declare_options(Options& options, LampFigureOptions& f) {
  options.section(kSection);
  options.file(
      "figure", f.file,
      "draw the scene, lit by one point lamp that casts no shadows, to this OpenEXR file (cd/m2), as "
      "figure 6 of Gautron et al. 2004: from above the exact reflection, the reflection through "
      "hemispherical harmonics (HSH) and through spherical harmonics (SH); a column for each order. "
      "The scene's own lights do not shine",
      FileUse::written);
  options.text("figure-lamp", f.lamp, "X,Y,Z", "place of the lamp, metres in the axes of the scene",
               Recorded::if_given);
  options.number("figure-intensity", f.intensity_cd, "CD",
                 "luminous intensity of the lamp of --figure-lamp in all directions, candela", kPositive,
                 Recorded::if_given);
  options.text(
      "figure-lamp-from", f.lamp_from, "X,Y,Z",
      "instead of --figure-lamp: direction from the scene to a lamp infinitely far away, of any length",
      Recorded::if_given);
  options.number("figure-illuminance", f.illuminance_lx, "LX",
                 "illuminance by the lamp of --figure-lamp-from on a surface that faces it, lux", kPositive,
                 Recorded::if_given);
  options.list("figure-orders", f.orders, "N,...",
               text("orders of the harmonics, 1 to ", kMostOrder.as<int>(), "; one column each"),
               Recorded::if_given);
  options.choice<FigureWeight>(
      "figure-weight", f.weight, {{"cosine", FigureWeight::cosine}, {"none", FigureWeight::none}},
      "the function that the harmonics hold: cosine: the BRDF times the cosine of the incident direction, as "
      "in the .brdf file; none: the BRDF alone, as in the paper, times the cosine afterwards",
      Recorded::if_given);
  Names<std::optional<HshRotation>> rotations{{"none", std::nullopt}};
  std::string words =
      "how the HSH of the lamp's light come into the frame of each surface: none: they are made there";
  for (const HshRotationRow& row : kHshRotations) {
    rotations.emplace_back(row.name, row.method);
    words += text("; ", row.name, ": ", row.does);
  }
  words += ". All but none start in a frame whose z axis points to the lamp. SH rotate without error";
  options.choice<std::optional<HshRotation>>("figure-rotation", f.rotation, rotations, words,
                                             Recorded::if_given);
  options.text("camera", f.camera, "NAME", "camera of the figure (default: the first of the scene)",
               Recorded::if_given);
  options.integer("width", f.width, "PIXELS",
                  "width of each picture of the figure; the height follows from the camera's aspect",
                  {1, kMostPictureSide.as<double>()}, Recorded::if_given);
  options.integer("pixel-samples", f.pixel_samples, "N", "samples of each pixel of the figure", {1, 65536},
                  Recorded::if_given);
}

void check_usage(const Options& options, const LampFigureOptions& f) {
  const auto refuse = [](const char* option, const std::string& why) {
    throw Error(ExitCode::usage, option, why);
  };
  if (f.file.empty()) {
    if (const std::string other = options.first_given_in(kSection); !other.empty())
      throw Error(ExitCode::usage, other, "is of a figure; give --figure FILE.exr too, or leave it out");
    return;
  }
  if (!f.file.ends_with(".exr"))
    refuse("--figure", text(f.file, ": the name must end in .exr; phos-picture turns the file into a PNG"));
  if (f.lamp.empty() && f.lamp_from.empty())
    refuse("--figure",
           "needs a lamp; give its place, --figure-lamp X,Y,Z, or its direction, "
           "--figure-lamp-from X,Y,Z");
  if (!f.lamp.empty() && !f.lamp_from.empty())
    refuse("--figure-lamp-from", "is a second lamp beside --figure-lamp; leave one out");
  if (!f.lamp.empty() && options.given("figure-illuminance"))
    refuse("--figure-illuminance", "is of --figure-lamp-from; give --figure-intensity CD for --figure-lamp");
  if (!f.lamp_from.empty() && options.given("figure-intensity"))
    refuse("--figure-intensity", "is of --figure-lamp; give --figure-illuminance LX for --figure-lamp-from");
  lamp_of(f);
  orders_of(f);
}

FigureLamp lamp_of(const LampFigureOptions& f) {
  if (!f.lamp.empty()) return {false, three_numbers("figure-lamp", f.lamp), f.intensity_cd};
  const DVec3 towards = three_numbers("figure-lamp-from", f.lamp_from);
  const double largest = std::max({std::abs(towards.x), std::abs(towards.y), std::abs(towards.z)});
  if (!(largest > 0)) reject_option("figure-lamp-from", "0,0,0 is no direction; give one such as 0,1,0");
  return {true, glm::normalize(towards / largest), f.illuminance_lx};
}

std::vector<int> orders_of(const LampFigureOptions& f) {
  std::vector<int> orders;
  for (const std::string& word : f.orders) {
    const int order = parse_number<int>("figure-orders", word, {1, kMostOrder.as<double>()});
    if (std::find(orders.begin(), orders.end(), order) == orders.end()) orders.push_back(order);
  }
  if (orders.empty()) reject_option("figure-orders", "names no order; give one such as 7");
  return orders;
}

}  // namespace phos::inline radiance
