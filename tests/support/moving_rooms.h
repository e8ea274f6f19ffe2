// Small closed rooms in which something moves, to test predictions from one frame to the next.
#pragma once

#include <string>

#include "support/scenes.h"

namespace phos::test {

enum class Mover { nothing, lamp, dimmer, occluder, wall, floor, elsewhere };

/// A room of 4 x 3 x 4 m with two grey tones, a point light, and a box. At `t` = 1 one part has moved:
/// lamp: by 0.3 m; dimmer: the lamp has 0.8 of its light; occluder: the box that casts a shadow, by 0.15 m;
/// wall: a bright screen, 0.2 m nearer; floor: a platform that records lie on rises and tilts; elsewhere: a
/// box outside of the room.
inline Scene moving_room(Mover mover, float t, float scale = 1) {
  const auto at = [&](Mover which) { return mover == which ? t : 0.f; };
  Scene scene;
  begin_instance(scene, "walls", add_lambert(scene, "grey", 0.5f));
  add_room(scene, scale * Vec3(0), scale * Vec3(4, 3, 4));
  begin_instance(scene, "screen", add_lambert(scene, "bright", 0.8f));
  const float nearer = 0.2f * at(Mover::wall);
  add_quad(scene, scale * Vec3(0.5f + nearer, 0.3f, 0.6f), scale * Vec3(0, 2.2f, 0),
           scale * Vec3(0, 0, 2.5f));
  begin_instance(scene, "box", 0);
  const Vec3 box = Vec3(2.2f, 1.2f, 1.2f) + 0.15f * at(Mover::occluder) * Vec3(-1, 0, 1);
  for (const bool high : {false, true}) {  // two sheets that face outwards
    const float y = high ? 0.3f : 0.f;
    const Vec3 u = high ? Vec3(0, 0, 0.8f) : Vec3(0.8f, 0, 0), v = high ? Vec3(0.8f, 0, 0) : Vec3(0, 0, 0.8f);
    add_quad(scene, scale * (box + Vec3(0, y, 0)), scale * u, scale * v);
  }
  begin_instance(scene, "platform", 0);
  const Vec3 rise = at(Mover::floor) * Vec3(0.05f, 0.1f, 0), tilt = at(Mover::floor) * Vec3(0, 0.08f, 0);
  add_quad(scene, scale * (Vec3(1.5f, 0.2f, 1.5f) + rise), scale * Vec3(0, 0, 1.2f),
           scale * (Vec3(1.2f, 0, 0) + tilt));
  begin_instance(scene, "outside", 0);
  add_quad(scene, scale * Vec3(6, 1 + at(Mover::elsewhere), 0), scale * Vec3(0, 0, 1), scale * Vec3(1, 0, 0));
  add_point_light(scene, scale * (Vec3(2.6f, 2.6f, 1.5f) - 0.3f * at(Mover::lamp) * Vec3(1, 0, 0)),
                  100 * scale * scale * (1 - 0.2f * at(Mover::dimmer)));
  finalize(scene);
  return scene;
}

inline std::string name_of(Mover mover) {
  constexpr const char* kNames[] = {"nothing", "lamp", "dimmer", "occluder", "wall", "floor", "elsewhere"};
  return kNames[static_cast<int>(mover)];
}

}  // namespace phos::test
