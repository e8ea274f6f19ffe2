// Tables of the papers by pipelines/reproduce.sh, at toy size, and the scenes that it makes.
#include <gtest/gtest.h>

#include <filesystem>

#include "file/csv.h"
#include "support/script.h"

namespace phos::test {
namespace {

class Reproduce : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-reproduce"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  test::Run reproduce(std::vector<std::string> arguments) const {
    return run_script("reproduce.sh", arguments, folder_);
  }
  test::Run make(const std::string& name, const std::string& file) const {
    return run_shell({"python3", "-B", std::string(PHOS_SOURCE) + "/pipelines/scenes/make.py", name, file},
                     folder_);
  }
  static bool has_python() { return std::system("command -v python3 >/dev/null") == 0; }
  std::string folder_;
};

/// The rows of a finished table; the last one tells the settings.
CsvTable table(const std::string& path) {
  CsvTable t = parse_csv(slurp(path), path);
  EXPECT_EQ(t.rows.back()[0], "settings") << path;
  return t;
}

/// `ours` of the row of that quantity.
std::string ours(const CsvTable& t, const std::string& quantity) {
  for (const auto& row : t.rows)
    if (row[0] == quantity) return row[t.column("ours", "")];
  ADD_FAILURE() << t.where << ": no row " << quantity;
  return "";
}

}  // namespace

TEST_F(Reproduce, EveryTableAtToySize) {
  const test::Run list = reproduce({"--list"});
  ASSERT_EQ(list.code, 0) << list.err;
  const test::Run run = reproduce({"out", "--toy"});
  ASSERT_EQ(run.code, 0) << run.err << slurp(path("out/log.txt"));
  const std::string page = slurp(path("out/index.html"));
  std::size_t tables = 0;
  std::istringstream lines(list.out);
  for (std::string name, rest; lines >> name && std::getline(lines, rest); ++tables) {
    const CsvTable t = table(path("out/" + name + ".csv"));
    EXPECT_GE(t.rows.size(), 2u) << name;
    for (const auto& row : t.rows) {
      EXPECT_FALSE(row[t.column("why", "")].empty()) << name << ": " << row[0];
      const std::string& verdict = row[t.column("verdict", "")];
      EXPECT_TRUE(verdict == "agrees" || verdict == "better" || verdict == "worse" || verdict == "skipped" ||
                  verdict == "-")
          << name << ": " << row[0] << ": " << verdict;
    }
    EXPECT_NE(page.find("<h2 id=\"" + name + "\">"), std::string::npos) << name;
  }
  EXPECT_EQ(tables, 16u);
  EXPECT_NE(page.find("toy size"), std::string::npos);
  EXPECT_NE(page.find("<img src=\"hsh-bases/phong-cosine.svg\">"), std::string::npos);
  // The bases do not depend on the size: 25 functions of HSH hold 0.998 of Phong cos^5 times cosine, of SH
  // 0.936.
  const CsvTable bases = table(path("out/hsh-bases.csv"));
  EXPECT_EQ(ours(bases, "Phong cos^5 times cosine, 25 functions: HSH and SH").substr(0, 5), "0.998");
  // Ward's lobe of 1992 without the cosine: 0.905, 1.325, 1.742, 2.159 1/sr (an independent program).
  double nearer = 0;
  std::istringstream energies(
      ours(bases, "integral of the square of Ward's lobe of 1992, above the cosines 0.01, 1e-4, 1e-6, 1e-8"));
  for (const double energy : {0.905, 1.325, 1.742, 2.159}) {
    std::string number;
    ASSERT_TRUE(std::getline(energies, number, ','));
    EXPECT_NEAR(std::stod(number), energy, 0.004);
    EXPECT_NEAR(std::stod(number) - nearer, nearer > 0 ? 0.4175 : energy, 0.006);
    nearer = std::stod(number);
  }
  // The page says so where the lobe is drawn.
  for (const char* picture : {"hsh-bases/ward-none.svg", "hsh-teapot/lamp-none.png"}) {
    const std::size_t at = page.find("<img src=\"" + std::string(picture) + "\">");
    ASSERT_NE(at, std::string::npos) << picture;
    const std::string caption = page.substr(at, page.find("</figcaption>", at) - at);
    EXPECT_NE(caption.find("its integral diverges as a logarithm"), std::string::npos) << caption;
    EXPECT_NE(caption.find("0.905, 1.325, 1.742, 2.159 1/sr"), std::string::npos) << caption;
  }
  EXPECT_GT(std::stod(ours(table(path("out/views.csv")), "records of the centre view")), 50);
  // Half of a disc is beyond a border; the hull is not.
  const CsvTable border = table(path("out/thesis-6.9.csv"));
  EXPECT_LT(std::stod(ours(border, "bias at the border, disc")), -40);
  EXPECT_GT(std::stod(ours(border, "bias at the border, convex hull")), -35);

  // What is there is kept; one table, if asked, is computed again and is the same.
  const auto before = std::filesystem::last_write_time(path("out/hsh-bases.csv"));
  const std::string rows = slurp(path("out/hsh-bases.csv"));
  const test::Run kept = reproduce({"out", "hsh-bases", "--toy"});
  EXPECT_EQ(kept.code, 0);
  EXPECT_NE(kept.err.find("hsh-bases: is there"), std::string::npos) << kept.err;
  EXPECT_EQ(std::filesystem::last_write_time(path("out/hsh-bases.csv")), before);
  EXPECT_EQ(reproduce({"out", "hsh-bases", "--toy", "--again"}).code, 0);
  EXPECT_NE(std::filesystem::last_write_time(path("out/hsh-bases.csv")), before);
  EXPECT_EQ(slurp(path("out/hsh-bases.csv")), rows);
}

TEST_F(Reproduce, WrongWordsAreRefused) {
  EXPECT_EQ(reproduce({}).code, 2);
  EXPECT_EQ(reproduce({"out", "--what"}).code, 2);
  EXPECT_EQ(reproduce({"out", "--seed", "many"}).code, 2);
  const test::Run run = reproduce({"out", "thesis-4.3"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("thesis-4.3: no such table; did you mean thesis-4.1?"), std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(Reproduce, ScenesAreWhole) {
  if (!has_python()) GTEST_SKIP() << "no python3";
  for (const char* name : {"hall", "nave", "kite", "room", "villa", "teapots"}) {
    const std::string file = std::string(name) + ".glb";
    const test::Run made = make(name, file);
    ASSERT_EQ(made.code, 0) << made.err;
    const test::Run scene = run_shell({"phos-scene", file, "--json"}, folder_);
    EXPECT_EQ(scene.code, 0) << scene.err;
    EXPECT_NE(scene.out.find("\"triangles\": " + made.out.substr(0, made.out.find('\n'))), std::string::npos)
        << name << made.out;
    // A figure lights the teapots by a lamp of its own.
    const bool lit = std::string(name) != "teapots";
    EXPECT_EQ(scene.out.find("\"error\"") == std::string::npos, lit) << name << scene.out;
  }
  // Newell's teapot: 3.15 high, 6.434 from handle to spout.
  ASSERT_EQ(make("teapot", "teapot.glb").code, 0);
  const test::Run teapot = run_shell({"phos-scene", "teapot.glb"}, folder_);
  EXPECT_NE(teapot.out.find("from -3 0 -2 to 3.434 3.15 2 m"), std::string::npos) << teapot.out;

  const test::Run wrong = make("castle", "castle.glb");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("castle: no such scene; give one of hall, nave"), std::string::npos) << wrong.err;
  EXPECT_EQ(make("hall", "nowhere/hall.glb").code, 3);
}

}  // namespace phos::test
