// The reference scenes arrive as the page beside each says: triangles, surface, flux of every light, cameras,
// models.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>

#include "scene/load.h"
#include "scene/report/describe.h"
#include "support/run.h"

namespace phos {
namespace {

double number_after(const std::string& page, const std::string& key) {
  const std::size_t at = page.find(key);
  return at == std::string::npos ? NAN : std::stod(page.substr(at + key.size()));
}

/// "- name: 2 tris, area 24 m2, radiance [...] W/(sr m2), flux 779.1 W mean of RGB" -> name, flux.
std::multimap<std::string, double> area_lights(const std::string& page) {
  std::multimap<std::string, double> out;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": "), flux = line.find(", flux ");
    if (line.rfind("- ", 0) == 0 && flux != std::string::npos) {
      out.emplace(line.substr(2, colon - 2), std::stod(line.substr(flux + 7)));
    }
  }
  return out;
}

std::size_t lines_of_section(const std::string& page, const std::string& title, const std::string& start) {
  std::istringstream lines(page.substr(std::min(page.find(title), page.size())));
  std::string line;
  std::getline(lines, line);
  std::size_t n = 0;
  while (std::getline(lines, line) && line.rfind("## ", 0) != 0) n += line.rfind(start, 0) == 0;
  return n;
}

TEST(SharedScenes, MatchTheirPages) {
  const std::string folder = test::shared("scenes");
  if (folder.empty()) GTEST_SKIP() << "the reference scenes are not beside the project";
  double seconds = 0;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".md" || entry.path().stem() == "INDEX") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    const std::string page = test::slurp(entry.path().string());
    const auto start = std::chrono::steady_clock::now();
    const Scene s = load_scene(folder + "/" + name + ".glb");
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++scenes;
    EXPECT_EQ(static_cast<double>(s.triangle.size()), number_after(page, "instances counted): "));
    double area = 0;
    for (std::uint32_t t = 0; t < s.triangle.size(); ++t) area += area_m2(s, t);
    EXPECT_NEAR(area, number_after(page, "; surface "), 1e-3 * area);
    EXPECT_EQ(s.camera.size(), lines_of_section(page, "## Cameras", "- "));
    EXPECT_EQ(s.light.size(), lines_of_section(page, "## Lights", "- "));
    EXPECT_EQ(s.material.size(), lines_of_section(page, "## Materials", "| ") - 1);
    std::multimap<std::string, double> expected = area_lights(page);
    double wanted = 0, got = 0;
    for (const auto& [light, watts] : expected) wanted += watts;
    for (const Light& l : s.light) {
      if (l.kind == Light::Kind::area) got += (l.flux_lm.x + l.flux_lm.y + l.flux_lm.z) / 3 / 179;
    }
    EXPECT_NEAR(got, wanted, 1e-3 * wanted + 1e-9);
  }
  EXPECT_GE(scenes, 17);
  EXPECT_LT(seconds, 10);
}

TEST(SharedScenes, ModelsMatchTheirPages) {
  const std::string folder = test::shared("scenes");
  if (folder.empty()) GTEST_SKIP() << "the reference scenes are not beside the project";
  for (const char* name :
       {"staircase2", "veach-bidir", "mcguire-cornellbox-sphere", "living-room", "glossy-torus"}) {
    SCOPED_TRACE(name);
    const Scene s = load_scene(folder + "/" + name + ".glb");
    std::map<std::string, std::string> models;
    for (const Material& m : s.material) models[m.name] = model_name(m.model);
    std::istringstream lines(test::slurp(folder + "/" + name + ".md"));
    int checked = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("| ", 0) != 0 || line.rfind("| name", 0) == 0) continue;
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
      std::string material, brdf;
      std::istringstream(cells.at(1)) >> material;
      std::istringstream(cells.at(7)) >> brdf;
      if (brdf.empty() || brdf == "area") continue;  // no extras.phos: the core material
      EXPECT_EQ(models[material], brdf) << material;
      ++checked;
    }
    EXPECT_GT(checked, 3);
  }
}

}  // namespace
}  // namespace phos
