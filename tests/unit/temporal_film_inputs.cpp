// The scene says at which frame a film is read.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.h"
#include "support/film_records.h"
#include "support/run.h"
#include "temporal/film/file.h"
#include "temporal/film/inputs.h"

namespace phos::test {
namespace {

std::string scratch_file(const std::string& name) { return scratch("film") + "/" + name; }

Scene scene_at(double frame) {
  Scene scene;
  scene.path = "room.glb";
  scene.time_s = frame / 24;
  scene.hash = text("hash ", std::llround(frame));
  return scene;
}

std::string refused(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::mismatch);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "";
}

TEST(FilmInputs, TheSceneSaysWhichFrame) {
  const std::string path = scratch_file("f.irradiance");
  const Film film = random_film(12, false, TemporalGradients::interpolated);
  write_film(path, film, irradiance_provenance());
  const Container file = Container::open(path);
  for (const int frame : {10, 14, 29}) {
    EXPECT_EQ(frame_of(scene_at(frame)), frame);
    EXPECT_EQ(refused([&] { require_same_scene(file, "", scene_at(frame)); }), "");
    EXPECT_EQ(read_irradiance_at(file, scene_at(frame)).records.size(),
              cache_at(film, frame, Scene()).records.size());
  }
  for (const int frame : {0, 9, 30}) {
    const std::string said = refused([&] { require_same_scene(file, "", scene_at(frame)); });
    EXPECT_NE(said.find("frames 10 to 29"), std::string::npos) << said;
    EXPECT_NE(refused([&] { read_irradiance_at(file, scene_at(frame)); }), "");
  }
  Scene other = scene_at(12);
  other.hash = "hash 13";
  EXPECT_NE(refused([&] { require_same_scene(file, "", other); }).find("another scene"), std::string::npos);
  other = scene_at(12.4);
  other.hash = "between";
  EXPECT_NE(refused([&] { require_same_scene(file, "", other); }).find("12.4"), std::string::npos);
}

TEST(FilmInputs, OfRadianceAndOfOrdinaryCaches) {
  const std::string film = scratch_file("f.radiance"), cache = scratch_file("g.radiance");
  write_film(film, random_radiance_film({2, 2, 2}, false, TemporalGradients::none), radiance_provenance());
  write_radiance(cache, random_radiance(4, 2), radiance_provenance());
  EXPECT_EQ(read_radiance_at(Container::open(film), scene_at(22)).records.size(), 1u);
  EXPECT_NE(refused([&] { read_radiance_at(Container::open(film), scene_at(2)); }), "");
  EXPECT_EQ(read_radiance_at(Container::open(cache), scene_at(22)).records.size(), 4u);
}

}  // namespace
}  // namespace phos::test
