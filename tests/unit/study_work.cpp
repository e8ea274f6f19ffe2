// Which commands a study runs, what they share, in which order, and what it remembers of them.
#include "study/work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/error.h"
#include "study/journal.h"
#include "study/run.h"
#include "support/run.h"

namespace phos {
namespace {

class StudyWorks : public ::testing::Test {
 protected:
  StudyWorks() : folder_(test::scratch("study-work")), runner_({}, PHOS_TOOLS) {
    std::filesystem::copy_file(test::data("cornell-empty.glb"), folder_ + "/box.glb");
  }
  /// The commands of a study with `more` after the scene.
  StudyWork work(const std::string& more) {
    test::spill(folder_ + "/s.toml", "[study]\nscenes = \"box.glb\"\n" + more);
    study_ = std::make_unique<StudyFile>(read_study(folder_ + "/s.toml", runner_));
    return plan_work(*study_, runner_, folder_ + "/cache");
  }
  static std::size_t count(const StudyWork& work, const std::string& section) {
    std::size_t n = 0;
    for (const std::size_t i : work.order()) n += work.stages[i].section == section ? 1 : 0;
    return n;
  }
  std::string folder_;
  CommandRunner runner_;
  std::unique_ptr<StudyFile> study_;
};

const std::string kGrid =
    "repeats = 2\n[photons]\nphotons = [1000, 2000]\n[irradiance]\naccuracy = [0.1, 0.2, 0.4]\n[splat]\n";

TEST_F(StudyWorks, SharedCommandsAreThereOnce) {
  const StudyWork w = work(kGrid);
  EXPECT_EQ(w.settings.size(), 6u);
  EXPECT_EQ(w.jobs.size(), 12u);
  EXPECT_EQ(count(w, "reference"), 2u);
  EXPECT_EQ(count(w, "photons"), 4u);
  EXPECT_EQ(count(w, "irradiance"), 12u);
  EXPECT_EQ(count(w, "splat"), 12u);
  EXPECT_EQ(w.order().size(), w.stages.size());
}

TEST_F(StudyWorks, OptionsOfALaterStageShareTheEarlierOnes) {
  const StudyWork w = work("[photons]\nphotons = 1000\n[irradiance]\n[splat]\npixel_samples = [1, 2, 4]\n");
  EXPECT_EQ(count(w, "photons"), 1u);
  EXPECT_EQ(count(w, "irradiance"), 1u);
  EXPECT_EQ(count(w, "splat"), 3u);
}

TEST_F(StudyWorks, CamerasShareWhatDoesNotSeeThem) {
  const std::string stages = "cameras = [\"measured\", \"left-view\"]\n[photons]\nphotons = 1000\n";
  EXPECT_EQ(count(work(stages + "[irradiance]\n[splat]\n"), "irradiance"), 1u);
  const StudyWork w = work(stages + "[irradiance]\nplace = \"view\"\ncamera = \"each\"\n[splat]\n");
  EXPECT_EQ(count(w, "irradiance"), 2u);
  EXPECT_EQ(count(w, "photons"), 1u);
  EXPECT_EQ(count(w, "reference"), 4u);
  EXPECT_EQ(w.pictures.size(), 2u);
}

/// Records for a view are placed for the pixels of the picture, unless the study says otherwise.
TEST_F(StudyWorks, RecordsForAViewAreOfThePicturesSize) {
  const auto records = [&](const std::string& more) {
    const StudyWork w = work("width = 300\n[photons]\nphotons = 1000\n[irradiance]\n" + more + "[splat]\n");
    return w.stages.shell_lines(*w.jobs[0].picture, "p")[1];
  };
  EXPECT_NE(records("place = \"view\"\n").find("--place view --width 300 "), std::string::npos);
  EXPECT_EQ(records("place = \"surface\"\n").find("--width"), std::string::npos);
  const std::string own = records("place = \"view\"\nwidth = 40\n");
  EXPECT_NE(own.find("--width 40"), std::string::npos);
  EXPECT_EQ(own.find("--width 300"), std::string::npos);
}

TEST_F(StudyWorks, RoundsGoTheOtherWay) {
  const StudyWork w = work(kGrid);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(w.jobs[i].setting, i);
    EXPECT_EQ(w.jobs[i].seed, 0u);
    EXPECT_EQ(w.jobs[6 + i].setting, 5 - i);
    EXPECT_EQ(w.jobs[6 + i].seed, 1u);
  }
  // In the second round the last setting's cache is made first.
  std::vector<std::string> accuracies;
  for (const std::size_t i : w.order())
    if (w.stages[i].section == "irradiance") {
      const auto& words = w.stages[i].command.arguments;
      accuracies.push_back(*(std::find(words.begin(), words.end(), "--accuracy") + 1));
    }
  EXPECT_EQ(accuracies[0], "0.1");
  EXPECT_EQ(accuracies[6], "0.4");
}

TEST_F(StudyWorks, InputsComeFirstInEveryChain) {
  const StudyWork w = work(kGrid);
  const std::vector<std::size_t> chain = w.stages.chain(*w.jobs[3].picture);
  ASSERT_EQ(chain.size(), 3u);
  EXPECT_EQ(w.stages[chain[0]].section, "photons");
  EXPECT_EQ(w.stages[chain[1]].section, "irradiance");
  EXPECT_EQ(w.stages[chain[2]].section, "splat");
  const std::vector<std::string> lines = w.stages.shell_lines(*w.jobs[3].picture, "p3");
  EXPECT_NE(lines[0].find("--photons 2000 --seed 0 -o p3.photons"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("p3.photons --accuracy 0.1 --seed 0 -o p3.irradiance"), std::string::npos)
      << lines[1];
  EXPECT_NE(lines[2].find("p3.irradiance --width 400 --seed 0 -o p3.exr"), std::string::npos) << lines[2];
}

TEST_F(StudyWorks, IdentityIsContentNotName) {
  const StudyWork before = work(kGrid);
  std::filesystem::copy_file(folder_ + "/box.glb", folder_ + "/same.glb");
  test::spill(folder_ + "/t.toml", "[study]\nscenes = \"same.glb\"\n" + kGrid);
  const StudyFile renamed = read_study(folder_ + "/t.toml", runner_);
  EXPECT_EQ(plan_work(renamed, runner_, folder_ + "/cache").stages[0].id, before.stages[0].id);

  const std::string other = test::slurp(test::data("cornell-glossy22.glb"));
  test::spill(folder_ + "/box.glb", other);
  const StudyWork after = plan_work(*study_, runner_, folder_ + "/cache");
  for (std::size_t i = 0; i < after.stages.size(); ++i) EXPECT_NE(after.stages[i].id, before.stages[i].id);
}

TEST_F(StudyWorks, FilesOfOptionsAreContentToo) {
  const std::string more = "[irradiance]\nat = \"at.csv\"\n[splat]\n";
  test::spill(folder_ + "/at.csv", "x,y,z,nx,ny,nz\n0.1,0,0.1,0,1,0\n");
  const auto id = [&] {
    const StudyWork w = work(more);
    return w.stages[w.stages.chain(*w.jobs[0].picture)[0]].id;
  };
  const std::string first = id();
  EXPECT_EQ(id(), first);
  test::spill(folder_ + "/at.csv", "x,y,z,nx,ny,nz\n0.2,0,0.1,0,1,0\n");
  EXPECT_NE(id(), first);
}

TEST(StudyJournal, RemembersWhatIsWhole) {
  const std::string path = test::scratch("study-journal") + "/journal.jsonl";
  {
    StudyJournal journal(path);
    journal.add("a", {"phos-photons", {"room.glb"}, "a.photons"}, {1.5, 2.5, 3, 4});
    journal.add("b", {"phos-splat", {"room.glb"}, "b.exr"}, {1, 2, 3, 4});
    EXPECT_THROW(StudyJournal{path}, Error) << "two at once";
  }
  const std::string whole = test::slurp(path);
  const std::size_t second = whole.find('\n') + 1;
  for (std::size_t cut = second; cut <= whole.size(); ++cut) {
    test::spill(path, whole.substr(0, cut));
    StudyJournal journal(path);
    ASSERT_TRUE(journal.find("a"));
    EXPECT_EQ(journal.find("a")->wall_s, 1.5);
    EXPECT_EQ(journal.find("a")->peak_bytes, 3u);
    // Cut in its last brace it is no JSON; without its newline it is whole.
    EXPECT_EQ(journal.find("b") != nullptr, cut + 1 >= whole.size()) << cut;
    journal.add("c", {"phos-splat", {}, "c.exr"}, {1, 2, 3, 4});
    EXPECT_TRUE(journal.find("c"));
  }
  EXPECT_TRUE(StudyJournal(path).find("c"));
}

TEST_F(StudyWorks, LeftIsWhatIsNotDone) {
  const StudyWork w = work("[photons]\nphotons = 1000\n[irradiance]\naccuracy = [0.2, 0.4]\n[splat]\n");
  std::filesystem::create_directories(folder_ + "/cache");
  StudyJournal journal(folder_ + "/journal.jsonl");
  EXPECT_EQ(work_left(w, journal).size(), 7u);
  const auto finish = [&](std::size_t i) {
    test::spill(w.stages[i].command.output, "1234");
    journal.add(w.stages[i].id, w.stages[i].command, {1, 1, 1, 4});
  };
  for (const std::size_t i : w.order()) finish(i);
  EXPECT_TRUE(work_left(w, journal).empty());
  const std::vector<std::size_t> chain = w.stages.chain(*w.jobs[0].picture);
  // A cache that nobody is to read may go; a picture may not, and what it reads is made with it.
  std::filesystem::remove(w.stages[chain[1]].command.output);
  EXPECT_TRUE(work_left(w, journal).empty());
  test::spill(w.stages[chain[2]].command.output, "12");  // damaged
  EXPECT_EQ(work_left(w, journal), (std::vector<std::size_t>{chain[1], chain[2]}));
}

}  // namespace
}  // namespace phos
