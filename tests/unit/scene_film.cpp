// Frames: the same triangles at all of them, what changes, and what jumps.
#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "scene/motion/animation.h"
#include "scene/rays.h"
#include "support/animated.h"
#include "support/jumps.h"

namespace phos {
namespace {

using test::Animated;
using test::jumps_of;
using Frames = std::vector<std::int64_t>;

/// A floor, and above it what each test adds.
struct Room : Animated {
  Room() { slab("floor", 4, 0, 0, 0); }
};

TEST(Film, WhatHasNoAreaIsThereAndNothingHitsIt) {
  Room room;
  const int block = room.slab("block", 1, 0, 1, 0), lamp = room.slab("lamp", 1, 0, 2, 0, Animated::glow(100));
  room.animate(block, "scale", {0, 4}, {0, 0, 0, 1, 1, 1});
  room.animate(lamp, "scale", {0, 4}, {0, 0, 0, 1, 1, 1}, "STEP");
  const std::string path = room.write("film_no_area", 5);
  const Scene none = load_frame(path, {}, 0), some = load_frame(path, {}, 1), all = load_frame(path, {}, 4);
  for (const Scene* s : {&none, &some, &all}) {
    ASSERT_EQ(s->instance.size(), 3u);
    EXPECT_EQ(s->triangle.size(), 6u);
    for (const Vec3& n : s->normal) EXPECT_NEAR(glm::length(n), 1, 1e-6f);
    EXPECT_EQ(s->events.count("normals repaired"), 0u);
  }
  EXPECT_TRUE(none.light.empty());
  ASSERT_EQ(all.light.size(), 1u);
  EXPECT_NEAR(all.light[0].area_m2, 1, 1e-6f);
  EXPECT_EQ(none.bounds.size().y, 0);
  EXPECT_EQ(all.bounds.hi.y, 2);
  const RayScene rays(none), later(some);
  SurfacePoint p;
  for (const float x : {0.f, 0.05f}) {
    ASSERT_TRUE(trace(rays, {{x, 3, 0}, {0, -1, 0}}, p));
    EXPECT_EQ(p.instance, 0u);
    ASSERT_TRUE(trace(later, {{x, 3, 0}, {0, -1, 0}}, p));
    EXPECT_EQ(p.instance, 1u);
  }
}

TEST(Film, StaysOnItsKeys) {
  // Where its time is rounded up in float, a key lies behind the time of its frame.
  Keyframes keys;
  keys.time_s = {0, 0, 1};
  keys.width = 1, keys.value = {1, 2, 3};
  for (const auto i : {Interpolation::step, Interpolation::linear}) {
    keys.interpolation = i;
    for (int f = 1; f < 200; ++f) {
      keys.time_s[1] = static_cast<float>(f / 240.);
      EXPECT_FLOAT_EQ(sample_keyframes(keys, f / 240.)[0], 2) << f;
    }
  }
}

TEST(Film, NothingChanges) {
  Room room;
  room.slab("lamp", 1, 0, 2, 0, Animated::glow(100));
  room.animate(room.camera("eye"), "translation", {0, 4}, {0, 1, 1, 0, 1, 1});
  const std::string path = room.write("film_still", 5);
  const Scene a = load_frame(path, {}, 0), b = load_frame(path, {}, 3);
  const Changes c = changes(a, b);
  EXPECT_EQ(c.moved, std::vector<bool>(2, false));
  EXPECT_FALSE(c.light() || c.cameras);
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_EQ(jumps_of(path, 5), Frames());
}

TEST(Film, SaysWhatChanges) {
  Room room;
  const int block = room.slab("block", 1, 0, 1, 0);
  room.slab("lamp", 1, 0, 2, 0, Animated::glow(100));
  room.lamp("bulb", "point", 10, 1, 1, 1);
  const int eye = room.camera("eye");
  room.animate(block, "translation", {0, 1}, {0, 1, 0, 0.5f, 1, 0});
  room.animate(eye, "translation", {1, 2}, {0, 1, 1, 0, 1, 2});
  room.animate("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {2, 3},
               {100, 200});
  room.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {3, 4}, {10, 20});
  const std::string path = room.write("film_changes", 5);
  std::vector<Scene> at;
  for (int f = 0; f < 5; ++f) at.push_back(load_frame(path, {}, f));
  const Changes moved = changes(at[0], at[1]), cut = changes(at[1], at[2]), glows = changes(at[2], at[3]),
                shines = changes(at[3], at[4]);
  EXPECT_EQ(moved.moved, (std::vector<bool>{false, true, false}));
  EXPECT_FALSE(moved.lights || moved.materials || moved.cameras);
  EXPECT_TRUE(moved.light());
  EXPECT_TRUE(cut.cameras);
  EXPECT_FALSE(cut.light());
  EXPECT_TRUE(glows.materials && glows.lights && glows.light());
  EXPECT_FALSE(glows.anything_moved());
  EXPECT_TRUE(shines.lights);
  EXPECT_FALSE(shines.materials);
}

TEST(Film, MovedLampIsAChangeOfLights) {
  Room room;
  const int lamp = room.slab("lamp", 1, 0, 2, 0, Animated::glow(100));
  room.animate(lamp, "translation", {0, 4}, {0, 2, 0, 1, 2, 0});
  const std::string path = room.write("film_lamp", 5);
  EXPECT_TRUE(changes(load_frame(path, {}, 0), load_frame(path, {}, 1)).lights);
}

TEST(Film, OtherScenesAreRefused) {
  Room one, two;
  one.slab("block", 1, 0, 1, 0);
  two.slab("ball", 1, 0, 1, 0);
  const Scene a = load_scene(one.write("film_one", 1)), b = load_scene(two.write("film_two", 1)),
              c = load_scene(Room().write("film_three", 1));
  for (const Scene* other : {&b, &c}) {
    try {
      changes(a, *other);
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(e.what()).find(other == &b ? "\"ball\"" : "\"block\""), std::string::npos)
          << e.what();
    }
  }
}

TEST(Film, OwnTimesAreRefused) {
  const std::string path = Room().write("film_times", 1);
  SceneOptions time, frame;
  time.time_s = 1, frame.frame = 1;
  for (const SceneOptions& o : {time, frame}) EXPECT_THROW(load_frame(path, o, 0), Error);
}

TEST(Film, FramesOfAnAnimation) {
  Room room;
  room.animate(room.slab("block", 1, 0, 1, 0), "translation", {0, 4}, {0, 1, 0, 1, 1, 0});
  const Scene s = load_frame(room.write("film_range", 5), {}, 0);
  EXPECT_NO_THROW(require_frames(s, {0, 4}));
  for (const FrameRange& range : {FrameRange{0, 5}, {5, 5}, {-1, 2}}) {
    try {
      require_frames(s, range);
      FAIL() << range.first << ":" << range.last;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      EXPECT_NE(std::string(e.what()).find("0:4"), std::string::npos) << e.what();
    }
  }
  EXPECT_NO_THROW(require_frames(load_scene(Room().write("film_any", 1)), {7, 1000}));
}

// --- jumps: what is named jumps at frame 5 of 10

struct Case {
  std::string name;
  std::function<void(Room&)> make;
  Frames jumps;
};

const char* const kBulb = "/extensions/KHR_lights_punctual/lights/0/intensity";

/// Values of a smooth movement by `x`, at every frame from `begin` in `frames`.
std::vector<float> eased(int frames, float x) {
  std::vector<float> out;
  for (int i = 0; i <= frames; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(frames);
    out.insert(out.end(), {x * t * t * (3 - 2 * t), 1, 0});
  }
  return out;
}

const std::vector<Case> kCases = {
    {"bulb switched on",
     [](Room& r) {
       r.lamp("bulb", "point", 9, 0, 1, 0), r.animate(kBulb, {0, 5}, {0, 9}, "STEP");
     },
     {5}},
    {"bulb switched off",
     [](Room& r) {
       r.lamp("bulb", "spot", 9, 0, 1, 0), r.animate(kBulb, {0, 5}, {9, 0}, "STEP");
     },
     {5}},
    {"sun dimmed at once",
     [](Room& r) {
       r.lamp("sun", "directional", 9, 0, 1, 0), r.animate(kBulb, {0, 5}, {9, 7}, "STEP");
     },
     {5}},
    {"bulb fades",
     [](Room& r) {
       r.lamp("bulb", "point", 9, 0, 1, 0), r.animate(kBulb, {0, 9}, {9, 0});
     },
     {}},
    {"bulb fades in two frames",
     [](Room& r) {
       r.lamp("bulb", "point", 9, 0, 1, 0), r.animate(kBulb, {4, 6}, {9, 0});
     },
     {}},
    {"bulb flickers a little",
     [](Room& r) {
       r.lamp("bulb", "point", 9, 0, 1, 0), r.animate(kBulb, {0, 5, 6}, {9, 8.5f, 9}, "STEP");
     },
     {}},
    {"bulb teleports",
     [](Room& r) {
       r.animate(r.lamp("bulb", "point", 9, 0, 1, 0), "translation", {0, 5}, {0, 1, 0, 1, 1, 0}, "STEP");
     },
     {5}},
    {"bulb runs",
     [](Room& r) {
       r.animate(r.lamp("bulb", "point", 9, 0, 1, 0), "translation", {0, 9}, {0, 1, 0, 90, 1, 0});
     },
     {}},
    {"spot turns at once",
     [](Room& r) {
       r.animate(r.lamp("spot", "spot", 9, 0, 1, 0), "rotation", {0, 5}, {0, 0, 0, 1, 1, 0, 0, 0}, "STEP");
     },
     {5}},
    {"spot turns",
     [](Room& r) {
       r.animate(r.lamp("spot", "spot", 9, 0, 1, 0), "rotation", {0, 9}, {0, 0, 0, 1, 1, 0, 0, 0});
     },
     {}},
    {"area light switched on",
     [](Room& r) {
       r.slab("lamp", 1, 0, 2, 0, Animated::glow(9)),
           r.animate("/materials/0/emissiveFactor", {0, 5}, {0, 0, 0, 1, 1, 1}, "STEP");
     },
     {5}},
    {"area light becomes red",
     [](Room& r) {
       r.slab("lamp", 1, 0, 2, 0, Animated::glow(9)),
           r.animate("/materials/0/emissiveFactor", {0, 5}, {0, 0, 1, 1, 0, 0}, "STEP");
     },
     {5}},
    {"area light fades in",
     [](Room& r) {
       r.slab("lamp", 1, 0, 2, 0, Animated::glow(9)),
           r.animate("/materials/0/emissiveFactor", {0, 9}, {0, 0, 0, 1, 1, 1});
     },
     {}},
    {"object teleports",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 5}, {0, 1, 0, 1, 1, 0}, "STEP");
     },
     {5}},
    {"object leaps on its way",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 4, 5, 9},
                 {0, 1, 0, 0.4f, 1, 0, 1.4f, 1, 0, 1.8f, 1, 0});
     },
     {5}},
    {"object appears",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "scale", {0, 5}, {0, 0, 0, 1, 1, 1}, "STEP");
     },
     {5}},
    {"object vanishes",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "scale", {0, 5}, {1, 1, 1, 0, 0, 0}, "STEP");
     },
     {5}},
    {"object grows out of nothing",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "scale", {0, 9}, {0, 0, 0, 1, 1, 1});
     },
     {}},
    {"object slides open",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "scale", {0, 9}, {0, 1, 1, 1, 1, 1});
     },
     {}},
    {"object teleports unseen",
     [](Room& r) {
       const int block = r.slab("block", 1, 0, 1, 0);
       r.animate(block, "scale", {0, 3, 6, 9}, {1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1});
       r.animate(block, "translation", {0, 5}, {0, 1, 0, 1, 1, 0}, "STEP");
     },
     {}},
    {"object appears after a run unseen",
     [](Room& r) {
       const int block = r.slab("block", 1, 0, 1, 0);
       r.animate(block, "scale", {0, 5}, {0, 0, 0, 1, 1, 1}, "STEP");
       r.animate(block, "translation", {0, 4}, {0, 1, 0, 90, 1, 0});
     },
     {5}},
    {"object is mirrored",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "scale", {0, 5}, {1, 1, 1, -1, 1, 1}, "STEP");
     },
     {5}},
    {"object runs",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 9}, {0, 1, 0, 90, 1, 0});
     },
     {}},
    {"object starts and stops at corners",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 3, 7, 9},
                 {0, 1, 0, 0, 1, 0, 4, 1, 0, 4, 1, 0});
     },
     {}},
    {"object turns back",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 5, 9}, {0, 1, 0, 5, 1, 0, 1, 1, 0});
     },
     {}},
    {"object moves by a spline",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {1, 8},
                 {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 7, 1, 0, 0, 0, 0}, "CUBICSPLINE");
     },
     {}},
    {"object moves by steps of a spline",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {3, 4, 5, 6}, eased(3, 1));
     },
     {}},
    {"object spins",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "rotation", {0, 4, 8}, {0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, -1});
     },
     {}},
    {"object shivers",
     [](Room& r) {
       r.animate(r.slab("block", 1, 0, 1, 0), "translation", {0, 5, 6}, {0, 1, 0, 0.05f, 1, 0, 0, 1, 0},
                 "STEP");
     },
     {}},
    {"camera cuts",
     [](Room& r) {
       r.animate(r.camera("eye"), "translation", {0, 5}, {0, 1, 0, 90, 1, 0}, "STEP");
     },
     {}},
};

TEST(Film, Jumps) {
  for (const Case& c : kCases) {
    Room room;
    c.make(room);
    EXPECT_EQ(jumps_of(room.write("film_jumps", 10), 10), c.jumps) << c.name;
  }
}

}  // namespace
}  // namespace phos
