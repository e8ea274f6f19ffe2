#include "radiance/gloss_report.h"

#include <cmath>

#include "core/error.h"
#include "core/text/append_item.h"
#include "core/text/quantity.h"

namespace phos::inline radiance {
namespace {

std::string title(const Json& choice) {
  const std::string& name = choice.find("material")->as_string();
  return name.empty() ? text("material ", choice.find("index")->as_integer()) : name;
}

Json requirement(const char* what, const std::string& why) {
  Json item;
  item["what"] = what;
  item["why"] = why;
  return item;
}

}  // namespace

Json gloss_report(const Scene& scene, const GlossTables& tables) {
  Json report = Json::Array{};
  for (const GlossChoice& choice : tables.choices()) {
    Json j;
    j["material"] = scene.material[choice.material].name;
    j["index"] = choice.material;
    j["order"] = choice.order;
    j["traced_share"] = choice.traced_share;
    j["why"] = choice.why;
    report.push_back(j);
  }
  return report;
}

std::string gloss_text(const Json& report) {
  std::string out;
  for (const Json& choice : report.as_array()) {
    const std::int64_t order = choice.find("order")->as_integer();
    const double traced = choice.find("traced_share")->as_number();
    out += text("  ", title(choice), ": ");
    if (order == 0)
      out += "traced";
    else if (traced > 0)
      out += text("records of order ", order, ", ", percent_to_tenths(traced), " of directions traced");
    else
      out += text("records of order ", order);
    out += text("; ", choice.find("why")->as_string(), "\n");
  }
  return out;
}

void add_gloss(Json& description, const Json& report) {
  std::string recorded, traced;
  for (const Json& choice : report.as_array()) {
    const auto add = [&](std::string& names) { append_item(names, title(choice)); };
    if (choice.find("order")->as_integer() > 0) add(recorded);
    if (choice.find("traced_share")->as_number() > 0) add(traced);
  }
  Json needed = Json::Array{};
  for (const Json& item : description["requires"].as_array()) {
    if (item.find("what")->as_string() != "gloss") {
      needed.push_back(item);
      continue;
    }
    if (!recorded.empty()) needed.push_back(requirement("radiance records", "gloss of " + recorded));
    if (!traced.empty())
      needed.push_back(requirement("traced gloss", "gloss of " + traced + ", in some directions or all"));
  }
  description["requires"] = needed;
  description["gloss"] = report;
}

}  // namespace phos::inline radiance
