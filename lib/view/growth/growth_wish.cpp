#include "view/growth/growth_wish.h"

#include <cmath>

#include "core/error.h"
#include "view/message/reader.h"

namespace phos::inline view {
namespace {

template <class... Words>
[[noreturn]] void refuse(const Words&... words) {
  throw Error(ExitCode::bad_input, "message", text(words...));
}

bool is_near(const Bounds& scene, const Vec3& p) {
  if (scene.empty()) return false;
  const Vec3 margin(kBeyond * scene.diagonal_m());
  return glm::all(glm::greaterThanEqual(p, scene.lo - margin)) &&
         glm::all(glm::lessThanEqual(p, scene.hi + margin));
}

/// A unit normal that stays as it is where a file of points is read again; zero for one without a direction.
Vec3 settled_normal(Vec3 normal) {
  constexpr int kEnough = 8;
  for (int i = 0; i < kEnough; ++i) {
    const Vec3 unit = normalized_or_zero(normal);
    if (unit == normal) break;
    normal = unit;
  }
  return normal;
}

}  // namespace

GrowthWish read_growth_wish(std::string_view bytes, const Bounds& scene, std::size_t most) {
  const MessageReader message(bytes, MessageKind::wish);
  if (message.rows("wish") != 1) refuse("has ", message.rows("wish"), " wishes, not one");
  const std::size_t n = message.rows("point");
  if (n > most) refuse("has ", n, " points, and a message may have ", most);
  GrowthWish wish;
  wish.since = message.numbers("wish", "since")[0];
  wish.share = static_cast<double>(message.floats("wish", "share")[0]);
  wish.save = message.numbers("wish", "save")[0] != 0;
  // A float may lie a rounding below.
  if (!(wish.share >= kLeastShareAsked * (1 - 1e-6) && wish.share <= 1)) refuse("has the share ", wish.share);
  const std::vector<float> position = message.floats("point", "position"),
                           normal = message.floats("point", "normal");
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p(position[3 * i], position[3 * i + 1], position[3 * i + 2]);
    const Vec3 n = settled_normal({normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]});
    if (!is_near(scene, p)) refuse("has a point far off the scene: row ", i);
    if (n == Vec3(0)) refuse("has a normal without a direction: row ", i);
    wish.points.push_back({p, n});
  }
  return wish;
}

}  // namespace phos::inline view
