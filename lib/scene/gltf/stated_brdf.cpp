#include "scene/gltf/stated_brdf.h"

#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace phos::inline scene {

void check_colour(const Rgb& c, const std::string& what, const Fail& fail) {
  if (!is_finite(c) || c.x < 0 || c.y < 0 || c.z < 0) fail(what + " must be numbers that are not negative");
}

void StatedBrdf::fail(const std::string& message) const {
  owner_.fail(message);
  throw std::logic_error(message);  // not reached
}

float StatedBrdf::number(const char* key, double absent) const {
  const Json* v = find(key);
  if (v && (!v->is_number() || !std::isfinite(v->as_number()) || v->as_number() < 0)) {
    fail(text("extras.phos.", key, " must be a number that is not negative"));
  }
  return static_cast<float>(v ? v->as_number() : absent);
}

std::optional<Rgb> StatedBrdf::colour(const char* key) const {
  try {
    const std::optional<Rgb> c = rgb_at(phos_, key);
    if (c) check_colour(*c, text("extras.phos.", key), owner_.fail);
    return c;
  } catch (const std::runtime_error&) {
    fail(text("extras.phos.", key, " must be three numbers that are not negative"));
  }
}

void StatedBrdf::read_alpha(Material& material) const {
  const Json* alpha = find("alpha");
  if (alpha && alpha->is_array()) {
    if (alpha->as_array().size() != 2) fail("extras.phos.alpha must be one number or two");
    Json pair;
    pair["x"] = alpha->as_array()[0];
    pair["y"] = alpha->as_array()[1];
    const StatedBrdf each(pair, base_, owner_);
    material.alpha_x = each.number("x", 0);
    material.alpha_y = each.number("y", 0);
    return;
  }
  const float both = number("alpha", 0);
  material.alpha_x = number("ax", both);
  material.alpha_y = number("ay", both);
}

}  // namespace phos::inline scene
