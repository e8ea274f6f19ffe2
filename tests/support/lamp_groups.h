// A room of two groups of lamps as files, and caches of each group and of all lamps.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "support/run.h"

namespace phos::test {

struct LampGroups {
  std::string folder, scene;

  std::string cache(const std::string& name) const { return folder + "/" + name + ".irradiance"; }
  /// Words of a command line: the scene, and the groups by their names.
  std::vector<std::string> named() const {
    return {scene, "left=" + cache("left"), "right=" + cache("right")};
  }
};

/// The lamps are "lamp-left", "lamp-right" (one material) and the point "spot" above a desk. Caches are
/// "left", "right" (with the point) and "all".
inline LampGroups lamp_groups(const std::string& folder) {
  LampGroups groups{folder, folder + "/room.obj"};
  std::ostringstream vertices, faces;
  int count = 0;
  const auto quad = [&](const char* name, const char* material, const std::array<const char*, 4>& corners) {
    for (const char* corner : corners) vertices << "v " << corner << "\n";
    faces << "g " << name << "\nusemtl " << material << "\nf " << count + 1 << " " << count + 2 << " "
          << count + 3 << " " << count + 4 << "\n";
    count += 4;
  };
  quad("floor", "wall", {"0 0 0", "0 0 3", "4 0 3", "4 0 0"});
  quad("ceiling", "wall", {"0 2.5 0", "4 2.5 0", "4 2.5 3", "0 2.5 3"});
  quad("back", "wall", {"0 0 0", "4 0 0", "4 2.5 0", "0 2.5 0"});
  quad("left", "wall", {"0 0 3", "0 0 0", "0 2.5 0", "0 2.5 3"});
  quad("right", "wall", {"4 0 0", "4 0 3", "4 2.5 3", "4 2.5 0"});
  quad("desk", "wall", {"1.5 0.8 1", "1.5 0.8 2", "2.5 0.8 2", "2.5 0.8 1"});
  quad("lamp-left", "light", {"0.5 2.4 1", "1 2.4 1", "1 2.4 2", "0.5 2.4 2"});
  quad("lamp-right", "light", {"3 2.4 1", "3.5 2.4 1", "3.5 2.4 2", "3 2.4 2"});
  spill(groups.scene, "mtllib room.mtl\n" + vertices.str() + faces.str());
  spill(folder + "/room.mtl", "newmtl wall\nKd 0.7 0.6 0.5\nnewmtl light\nKd 0 0 0\nKe 2000 1800 1500\n");
  spill(folder + "/room.lights.json",
        R"({"lights":[{"name":"spot","kind":"point","position":[2,1.6,1.5],"intensity":40}],)"
        R"("cameras":[{"name":"view","eye":[2,1.4,6.2],"target":[2,1.2,0],"yfov_deg":45}]})");
  for (const auto& [name, lamps] :
       {std::pair("all", ""), {"left", "lamp-left"}, {"right", "lamp-right,spot"}}) {
    const std::string photons = folder + "/" + name + ".photons";
    std::vector<std::string> words{"photons", groups.scene, "--photons", "50000", "-o", photons};
    if (*lamps) words.insert(words.end(), {"--lamps", lamps});
    EXPECT_EQ(run_tool(words).code, 0) << name;
    EXPECT_EQ(
        run_tool({"irradiance", groups.scene, photons, "--place", "surface", "-o", groups.cache(name)}).code,
        0)
        << name;
  }
  return groups;
}

}  // namespace phos::test
