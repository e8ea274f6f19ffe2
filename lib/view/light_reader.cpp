#include "view/light_reader.h"

#include "core/error.h"
#include "scene/material/bsdf.h"
#include "view/message/reader.h"
#include "view/message/writer.h"

namespace phos::inline view {
namespace {

struct Question {
  std::uint32_t number = 0;
  Ray ray;
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
  question.number = message.numbers("ray", "number")[0];
  question.ray.origin = Vec3(vector("origin")), question.ray.direction = Vec3(direction / length);
  return question;
}

}  // namespace

std::string LightReader::answer(std::string_view question) const {
  const Question asked = read_question(question);
  SurfacePoint point;
  const bool hit = trace(rays_, asked.ray, point);
  Reading reading;
  float emitted_and_reflected = 0, reflected_stderr = 0;
  bool gloss = false;
  if (hit) {
    Sensors sensors;
    sensors.points.push_back({point.position, point.smooth_normal});
    SensorReport report;
    reading = read_light(sensors, rays_, lights_, caches_, options_, report)[0];
    const Bsdf bsdf(rays_.scene(), point);
    const Rgb reflectance = bsdf.diffuse_reflectance() / kPi;
    emitted_and_reflected = luminance(reading.components_lx * reflectance +
                                      emitted_luminance(rays_.scene(), point, -asked.ray.direction));
    reflected_stderr = reading.stderr_lx * luminance(reflectance);
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
  real("illuminance", reading.illuminance_lx), real("illuminance_stderr", reading.stderr_lx);
  real("direct", reading.direct_lx), real("indirect", reading.indirect_lx);
  real("luminance", emitted_and_reflected), real("luminance_stderr", reflected_stderr);
  return message.message();
}

}  // namespace phos::inline view
