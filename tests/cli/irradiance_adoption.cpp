// What --add-to takes from a cache follows from the declarations of options: no test here names them all.
#include <gtest/gtest.h>

#include "file/container.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos::test {
namespace {

std::string scene() { return data("cornell-glossy22.glb"); }

/// A folder with photons and lobes, made once.
const std::string& folder() {
  static const std::string path = [] {
    const std::string f = scratch("adoption");
    EXPECT_EQ(run_tool({"photons", scene(), "--photons", "5000", "-o", f + "/c.photons"}).code, 0);
    EXPECT_EQ(run_tool({"brdf", scene(), "-o", f + "/c.brdf"}).code, 0);
    return f;
  }();
  return path;
}

Json parameters(const std::string& path) { return Container::open(path).provenance().parameters; }

std::string shown(const Json& value) { return value.is_string() ? value.as_string() : value.dump(); }

/// Descriptions of the options that a program adopts from the file that it adds to.
std::vector<Json> adopted_by(const std::string& tool) {
  const Json all = parse_json(run_tool({tool, "--options-json"}).out, tool);
  std::vector<Json> adopted;
  for (const Json& option : all.find("options")->as_array())
    if (const Json* of = option.find("adopted"); of && of->as_string() == "estimate")
      adopted.push_back(option);
  return adopted;
}

/// A value that the option may have, and is not `was`.
std::string another(const Json& option, const Json& was) {
  if (const Json* choices = option.find("choices")) {
    for (const Json& choice : choices->as_array())
      if (!(choice == was)) return choice.as_string();
  }
  const Json *least = option.find("min"), *most = option.find("max");
  if (least && !(was == *least) && !option.find("min_excluded")->as_bool()) return least->dump();
  return most ? most->dump() : was.is_number() ? Json(was.as_number() * 2).dump() : "0.5";
}

/// Of a program and the words with which it makes a cache in little time.
void expect_adoption(const std::string& tool, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& settings, std::size_t at_least) {
  const std::string cache = folder() + "/c." + tool, more = folder() + "/more." + tool;
  const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& then) {
    words.insert(words.begin(), tool);
    words.insert(words.end(), inputs.begin(), inputs.end());
    words.insert(words.end(), then.begin(), then.end());
    words.insert(words.end(), {"--max-candidates", "5", "--quiet"});
    return run_tool(words);
  };
  std::vector<std::string> first = settings;
  first.insert(first.end(), {"-o", cache});
  ASSERT_EQ(run({}, first).code, 0);
  const Json was = parameters(cache);
  const Run same = run({"--add-to", cache}, {"-o", more});
  ASSERT_EQ(same.code, 0) << same.err;
  const Json is = parameters(more);
  const std::vector<Json> adopted = adopted_by(tool);
  EXPECT_GE(adopted.size(), at_least);
  std::size_t not_default = 0;
  for (const Json& option : adopted) {
    const std::string name = option.find("name")->as_string();
    const Json *before = was.find(name), *after = is.find(name);
    ASSERT_EQ(before == nullptr, after == nullptr) << name;
    const Json value = before ? *before : *option.find("default");
    if (before) {
      EXPECT_EQ(after->dump(), before->dump()) << name;
    }
    not_default += !(value == *option.find("default"));
    const std::string other = another(option, value);
    const Run contradiction = run({"--add-to", cache, "--" + name, other}, {"-o", folder() + "/no"});
    EXPECT_EQ(contradiction.code, 4) << name << ' ' << other << ": " << contradiction.err;
    const std::string says =
        value.is_null() ? "made without --" + name : "made with --" + name + ' ' + shown(value) + ", not ";
    EXPECT_NE(contradiction.err.find(says), std::string::npos) << says << ": " << contradiction.err;
    EXPECT_FALSE(std::filesystem::exists(folder() + "/no")) << name;
  }
  EXPECT_GE(not_default, settings.size() / 2);
}

TEST(Adoption, IrradianceRecordsAreMadeAsTheCacheSays) {
  expect_adoption("irradiance", {scene(), folder() + "/c.photons"},
                  {"--accuracy",    "0.3", "--min-radius",  "0.05", "--near-photons",   "64",
                   "--min-photons", "50",  "--max-photons", "500",  "--distance-rays",  "8",
                   "--rays",        "27",  "--leak-test",   "ray",  "--radius",         "least",
                   "--raster-side", "32",  "--kernel",      "cone", "--source-photons", "64"},
                  20);
}

TEST(Adoption, GatheredRecordsToo) {
  expect_adoption("irradiance", {scene(), folder() + "/c.photons"},
                  {"--estimate", "gather", "--rays", "27", "--error", "0.5", "--gradients", "none", "--paths",
                   "all", "--footprint", "adaptive", "--rho", "0.2", "--light-samples", "16"},
                  20);
}

TEST(Adoption, RadianceRecordsAreMadeAsTheCacheSays) {
  expect_adoption("radiance", {scene(), folder() + "/c.photons", folder() + "/c.brdf"},
                  {"--accuracy", "0.4", "--rays", "27", "--min-radius", "0.1", "--gradients", "analytic"},
                  10);
}

}  // namespace
}  // namespace phos::test
