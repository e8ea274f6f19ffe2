// One command, one file for each frame: Tool::takes_frames().
#include <gtest/gtest.h>

#include <csignal>

#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/tool.h"
#include "support/run.h"

namespace phos {
namespace {

struct Result {
  int code;
  std::string out, err;
  std::vector<double> made;  ///< frames whose body worked
};

/// A program whose "automatic" parameter becomes 10 + frame where it is not given.
Result run(std::vector<std::string> words, const std::function<void(Tool&, double)>& also = {}) {
  Tool tool("phos-test", "tests", "Tests.", 1);
  std::optional<double> frame, time, automatic;
  std::string extra, input;
  tool.options().number("frame", frame, "N", "frame");
  tool.options().number("time", time, "S", "time");
  tool.options().number("automatic", automatic, "X", "filled in");
  tool.options().file("extra", extra, "another output");
  tool.options().input("INPUT", input, "input", false);
  tool.takes_frames(frame);
  tool.fresh_each_frame(automatic);
  words.insert(words.begin(), "phos-test");
  std::vector<const char*> argv;
  for (const std::string& w : words) argv.push_back(w.c_str());
  Result result;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  result.code = tool.run(static_cast<int>(argv.size()), argv.data(), [&] {
    if (!input.empty()) tool.add_input("scene", input);
    const std::string more = tool.frame_path(extra, "--extra");
    if (tool.up_to_date()) return;
    result.made.push_back(frame.value_or(-1));
    if (!automatic) automatic = 10 + frame.value_or(0);
    if (also) also(tool, frame.value_or(-1));
    tool.counters().add("event", 2);
    tool.stat("frame seen", frame.value_or(-1));
    if (!more.empty()) test::spill(more, "more");
    const std::vector<float> v{static_cast<float>(frame.value_or(-1))};
    ContainerWriter writer;
    writer.add<float>("v", v, {1}, "m");
    writer.write(tool.output(), tool.provenance(FileKind::irradiance, "scene-hash", {}));
  });
  result.err = testing::internal::GetCapturedStderr();
  result.out = testing::internal::GetCapturedStdout();
  return result;
}

class Sequence : public testing::Test {
 protected:
  Sequence() : folder(test::scratch("sequence")) { test::spill(at("scene"), "scene"); }
  ~Sequence() override { std::filesystem::remove_all(folder); }
  std::string at(const std::string& name) const { return folder + "/" + name; }
  std::size_t files() const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
    return n;
  }
  std::string folder;
};

TEST_F(Sequence, EachFileIsTheOneOfItsFrame) {
  const Result all = run({at("scene"), "--frames", "3:5", "-o", at("%03d")});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.made, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(run({at("scene"), "--frame", "4", "-o", at("one")}).code, 0);
  EXPECT_EQ(test::slurp(at("004")), test::slurp(at("one")));
  EXPECT_EQ(run({at("scene"), "--frames", "4", "-o", at("again")}).code, 0);
  EXPECT_EQ(test::slurp(at("004")), test::slurp(at("again")));
  EXPECT_NE(test::slurp(at("003")), test::slurp(at("004")));
}

TEST_F(Sequence, ReuseMakesWhatIsMissing) {
  run({at("scene"), "--frames", "0:2", "-o", at("%d")});
  std::filesystem::remove(at("1"));
  const Result again = run({at("scene"), "--frames", "0:3", "--reuse", "-o", at("%d")});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.made, (std::vector<double>{1, 3}));
  const Result why = run({at("scene"), "--frames", "2:4", "--why", "-o", at("%d")});
  EXPECT_EQ(why.code, 0) << why.err;
  EXPECT_TRUE(why.made.empty());
  EXPECT_NE(why.out.find(at("2") + ": nothing differs"), std::string::npos) << why.out;
  EXPECT_NE(why.out.find(at("4") + ": not there"), std::string::npos) << why.out;
}

TEST_F(Sequence, WhyNamesNoNumberThatIsEqual) {
  run({at("scene"), "--frames", "2", "--automatic", "1", "-o", at("%d")});
  const Result why = run({at("scene"), "--frames", "2", "--automatic", "3", "--why", "-o", at("%d")});
  EXPECT_NE(why.out.find("automatic: 1"), std::string::npos) << why.out;
  EXPECT_EQ(why.out.find("parameter frame"), std::string::npos) << why.out;
}

TEST_F(Sequence, ErrorsNameTheFrameAndKeepWhatIsDone) {
  const Result r = run({at("scene"), "--frames", "7:9", "-o", at("%d")}, [](Tool&, double frame) {
    if (frame == 8) throw Error(ExitCode::numerical, "lamp", "too bright; dim it");
  });
  EXPECT_EQ(r.code, 5);
  EXPECT_EQ(r.err, "phos-test: frame 8: lamp: too bright; dim it\n");
  EXPECT_TRUE(std::filesystem::exists(at("7")));
  EXPECT_EQ(files(), 2u);
  const Result memory =
      run({at("scene"), "--frames", "7:9", "-o", at("%d")}, [](Tool&, double) { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, 6);
  EXPECT_NE(memory.err.find("frame 7: "), std::string::npos) << memory.err;
}

TEST_F(Sequence, MessagesNameTheFrameAndDoNotRepeat) {
  const Result r = run({at("scene"), "--frames", "0:2", "-o", at("%d")}, [](Tool& tool, double frame) {
    tool.say("the same");
    if (frame > 0) tool.warn("later");
  });
  EXPECT_EQ(r.err, "phos-test: frame 0: the same\nphos-test: warning: frame 1: later\n");
}

TEST_F(Sequence, StatsOfEachFrameAndTogether) {
  run({at("scene"), "--frames", "4:6", "-o", at("%d"), "--stats", at("s.json")},
      [](Tool& tool, double) { tool.stat("seconds.work", 2.0); });
  const Json stats = parse_json(test::slurp(at("s.json")), "stats");
  EXPECT_EQ(stats.find("counters")->find("event")->as_integer(), 6);
  EXPECT_EQ(stats.find("seconds.work")->as_number(), 6);
  const Json::Array& frames = stats.find("frames")->as_array();
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[2].find("frame")->as_integer(), 6);
  EXPECT_EQ(frames[2].find("frame seen")->as_number(), 6);
  EXPECT_EQ(frames[2].find("counters")->find("event")->as_integer(), 2);
  EXPECT_GE(frames[2].find("seconds.total")->as_number(), 0);
}

TEST_F(Sequence, OtherOutputsHaveNumbersToo) {
  EXPECT_EQ(run({"--frames", "1:2", "-o", at("%d"), "--extra", at("m%d")}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(at("m2")));
  const Result one = run({"--frames", "1:2", "-o", at("%d"), "--extra", at("m")});
  EXPECT_EQ(one.code, 2);
  EXPECT_NE(one.err.find("--extra"), std::string::npos) << one.err;
  EXPECT_EQ(run({"-o", at("100%"), "--extra", at("%m")}).code, 0) << "no sequence: names as they are";
  EXPECT_TRUE(std::filesystem::exists(at("%m")));
}

TEST_F(Sequence, UsageErrorsComeBeforeTheWork) {
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--frames", "1:2", "-o", at("one")},
                                             {"--frames", "1:2", "-o", at("%d-%d")},
                                             {"--frames", "2:1", "-o", at("%d")},
                                             {"--frames", "1:2", "--frame", "1", "-o", at("%d")},
                                             {"--frames", "1", "--time", "1", "-o", at("%d")}}) {
    const Result r = run(wrong);
    EXPECT_EQ(r.code, 2) << r.err;
    EXPECT_TRUE(test::is_one_line(r.err)) << r.err;
    EXPECT_TRUE(r.made.empty());
  }
  const Result folder_missing = run({"--frames", "1:2", "-o", at("no/%d")});
  EXPECT_EQ(folder_missing.code, 3);
  EXPECT_NE(folder_missing.err.find("make the folder first"), std::string::npos) << folder_missing.err;
  const Result no_frames = run({"-o", at("%04d")});
  EXPECT_EQ(no_frames.code, 2);
  EXPECT_NE(no_frames.err.find("--frames 0:47"), std::string::npos) << no_frames.err;
  EXPECT_EQ(run({"--frames", "1", "-o", at("one"), "--frames", ""}).made, (std::vector<double>{-1}));
}

/// The last test here: the signal stays with the process.
TEST_F(Sequence, InterruptKeepsTheFramesThatAreDone) {
  const Result r = run({at("scene"), "--frames", "0:9", "-o", at("%d")}, [](Tool&, double frame) {
    if (frame == 2) std::raise(SIGINT);
  });
  EXPECT_EQ(r.code, 130) << r.err;
  EXPECT_NE(r.err.find("frames 0 to 1 are done, --reuse goes on"), std::string::npos) << r.err;
  EXPECT_EQ(files(), 3u);  // the scene and two
}

}  // namespace
}  // namespace phos
