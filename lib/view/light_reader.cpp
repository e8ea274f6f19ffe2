#include "view/light_reader.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/material/bsdf.h"
#include "view/message/reader.h"
#include "view/message/writer.h"

namespace phos::inline view {
namespace {

struct Question {
  std::uint32_t number = 0, set = 0;
  Ray ray;
  std::vector<float> weight;  // of each group
};

Question read_question(std::string_view bytes) {
  const MessageReader message(bytes, MessageKind::question);
  if (message.rows("ray") != 1)
    throw Error(ExitCode::bad_input, "message", text("asks for ", message.rows("ray"), " rays, not for one"));
  const auto vector = [&](const char* name) {
    const std::vector<float> v = message.floats("ray", name);
    return DVec3(v[0], v[1], v[2]);
  };
  const DVec3 direction = vector("direction");
  const double length = glm::length(direction);
  if (!(length > 0)) throw Error(ExitCode::bad_input, "message", "has a ray without a direction");
  Question question;
  question.number = message.numbers("ray", "number")[0], question.set = message.numbers("ray", "set")[0];
  question.ray.origin = Vec3(vector("origin")), question.ray.direction = Vec3(direction / length);
  question.weight = message.floats("group", "weight");
  if (std::any_of(question.weight.begin(), question.weight.end(), [](float w) { return w < 0; }))
    throw Error(ExitCode::bad_input, "message", "has a weight below 0");
  return question;
}

/// What a reading tells, of one group or of several.
struct Answer {
  Reading reading;
  float luminance = 0, luminance_stderr = 0;

  void add(const Answer& other, float weight) {
    reading.illuminance_lx += weight * other.reading.illuminance_lx;
    reading.direct_lx += weight * other.reading.direct_lx;
    reading.indirect_lx += weight * other.reading.indirect_lx;
    reading.stderr_lx = std::hypot(reading.stderr_lx, weight * other.reading.stderr_lx);
    luminance += weight * other.luminance;
    luminance_stderr = std::hypot(luminance_stderr, weight * other.luminance_stderr);
  }
};

/// Of a ray that lands.
Answer read_group(const GroupLight& group, const Ray& ray, const SensorOptions& options) {
  SurfacePoint point;
  Answer answer;
  if (!trace(group.rays, ray, point)) return answer;
  Sensors sensors;
  sensors.points.push_back({point.position, point.smooth_normal});
  SensorReport report;
  answer.reading = read_light(sensors, group.rays, group.lights, group.caches, options, report)[0];
  const Scene& scene = group.rays.scene();
  const Rgb reflectance = Bsdf(scene, point).diffuse_reflectance() / kPi;
  answer.luminance =
      luminance(answer.reading.components_lx * reflectance + emitted_luminance(scene, point, -ray.direction));
  answer.luminance_stderr = answer.reading.stderr_lx * luminance(reflectance);
  return answer;
}

}  // namespace

std::string LightReader::answer(std::string_view question) const {
  const Question asked = read_question(question);
  if (asked.set >= sets_.size())
    throw Error(ExitCode::bad_input, "message", text("asks for set ", asked.set, " of ", sets_.size()));
  const GroupLights& groups = sets_[asked.set];
  if (asked.weight.size() != groups.size())
    throw Error(ExitCode::bad_input, "message",
                text("has ", asked.weight.size(), " weights for ", groups.size(), " groups"));
  SurfacePoint point;
  const bool hit = trace(groups[0].rays, asked.ray, point);
  Answer sum;
  bool gloss = false;
  if (hit) {
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (asked.weight[i] > 0) sum.add(read_group(groups[i], asked.ray, options_), asked.weight[i]);
    const Bsdf bsdf(groups[0].rays.scene(), point);
    gloss = bsdf.has_gloss() || bsdf.has_specular() || bsdf.transmits_diffusely();
  }
  MessageWriter message(MessageKind::reading);
  const auto number = [&](const char* name, std::uint32_t value) {
    message.add("reading", name, std::vector<std::uint32_t>{value});
  };
  const auto real = [&](const char* name, float value) {
    message.add("reading", name, std::vector<float>{value});
  };
  number("number", asked.number), number("hit", hit ? 1 : 0), number("has_gloss", gloss ? 1 : 0);
  message.add("reading", "position", std::vector<Vec3>{hit ? point.position : Vec3(0)});
  message.add("reading", "normal", std::vector<Vec3>{hit ? point.smooth_normal : Vec3(0)});
  real("illuminance", sum.reading.illuminance_lx), real("illuminance_stderr", sum.reading.stderr_lx);
  real("direct", sum.reading.direct_lx), real("indirect", sum.reading.indirect_lx);
  real("luminance", sum.luminance), real("luminance_stderr", sum.luminance_stderr);
  return message.message();
}

}  // namespace phos::inline view
