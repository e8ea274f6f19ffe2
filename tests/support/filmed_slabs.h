// Films of a small scene, made and looked at as a user would.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "support/animated.h"
#include "support/run.h"

namespace phos::test {

inline Run temporal(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "temporal");
  return run_tool(arguments);
}
/// With few rays and photons, and a small view: fast.
inline std::vector<std::string> quick(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(),
                   {"--rays", "64", "--photons", "5000", "--width", "24", "--accuracy", "0.4"});
  return arguments;
}

/// A broad Phong lobe beside a Lambert one.
inline Json waxed() {
  Json m;
  m["name"] = "waxed";
  m["extras"]["phos"]["brdf"] = "phong";
  m["extras"]["phos"]["kd"] = Json::Array{0.3, 0.3, 0.3};
  m["extras"]["phos"]["ks"] = Json::Array{0.4, 0.4, 0.4};
  m["extras"]["phos"]["exponent"] = 5;
  return m;
}

/// A diffuse half.
inline Json grey() {
  Json m;
  m["name"] = "grey";
  m["extras"]["phos"]["brdf"] = "lambert";
  m["extras"]["phos"]["kd"] = Json::Array{0.5, 0.5, 0.5};
  return m;
}

/// Two grey slabs that face each other, a lamp between them, and a camera that sees both.
struct Slabs : Animated {
  Slabs() {
    slab("floor", 4, 0, 0, 0, grey());
    slab("ceiling", 4, 0, 2, 0, grey());
    lamp_node = lamp("lamp", "point", 100, 0, 1, 0);
    eye = camera("eye");
    animate(eye, "translation", {0, 16}, {0, 1, 3, 0, 1, 3});
  }
  int lamp_node = 0, eye = 0;
};

/// Illuminance near the middle of the floor, moved by (x, z) m, lx: a column of phos-sense.
inline double lux(const std::string& scene, const std::string& film, int frame, float x = 0, float z = 0,
                  const std::string& column = "indirect_lx") {
  const std::string folder = scratch("temporal-lux");
  std::ostringstream point;
  point << "x,y,z,nx,ny,nz\n" << 0.3f + x << ",0," << 0.2f + z << ",0,1,0\n";
  spill(folder + "/p.csv", point.str());
  const test::Run run = run_tool({"sense", scene, film, "--frame", std::to_string(frame), "--points",
                                  folder + "/p.csv", "--quiet", "-o", folder + "/lux.csv"});
  EXPECT_EQ(run.code, 0) << run.err;
  std::istringstream lines(slurp(folder + "/lux.csv"));
  std::string names, values, name, value;
  std::getline(lines, names), std::getline(lines, values);
  std::istringstream name_in(names), value_in(values);
  while (std::getline(name_in, name, ',') && std::getline(value_in, value, ',') && name != column) {
  }
  EXPECT_EQ(name, column);
  return std::atof(value.c_str());
}

}  // namespace phos::test
