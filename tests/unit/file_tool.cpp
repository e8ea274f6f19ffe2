// What every program shares: options, exit codes, one-line errors, provenance, --reuse, --why, --stats.
#include "file/tool.h"

#include <gtest/gtest.h>

#include <new>

#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/reuse.h"
#include "support/run.h"

namespace phos {
namespace {

struct Result {
  int code;
  std::string out, err;
  bool worked = false;
};

/// A program with one parameter and one input that writes a container.
struct Program {
  int algorithm = 1;
  std::string variant;
  Tool::Output output = Tool::Output::required;
  std::function<void(Tool&)> body;
  Tool::ProvenanceReader provenance_reader;

  Result run(std::vector<std::string> words) const {
    Tool tool("phos-test", "tests", "Tests.", algorithm, output);
    double accuracy = 0.2;
    std::vector<std::string> inputs;
    tool.options().number("accuracy", accuracy, "A", "a parameter", kPositive);
    tool.options().inputs("INPUT", inputs, "inputs", false);
    if (provenance_reader) tool.set_provenance_reader(provenance_reader);
    words.insert(words.begin(), "phos-test");
    std::vector<const char*> argv;
    for (const std::string& w : words) argv.push_back(w.c_str());
    Result result;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    result.code = tool.run(static_cast<int>(argv.size()), argv.data(), [&] {
      tool.set_variant(variant);
      for (const std::string& path : inputs) tool.add_input("scene", path);
      if (output != Tool::Output::none && tool.up_to_date()) return;
      result.worked = true;
      if (body) return body(tool);
      write(tool, FileKind::irradiance);
    });
    result.err = testing::internal::GetCapturedStderr();
    result.out = testing::internal::GetCapturedStdout();
    return result;
  }

  static void write(Tool& tool, FileKind kind) {
    const std::vector<float> v{1, 2, 3};
    ContainerWriter writer;
    writer.add<float>("v", v, {3}, "m");
    writer.write(tool.output(), tool.provenance(kind, "scene-hash", {}));
  }
};

struct Folder {
  explicit Folder(const std::string& name) : path(test::scratch("tool-" + name)) {
    test::spill(scene(), "scene one");
  }
  std::string scene() const { return path + "/scene.glb"; }
  std::string out() const { return path + "/out"; }
  std::string path;
};

Program throwing(const std::function<void()>& what) {
  Program p;
  p.output = Tool::Output::none;
  p.body = [what](Tool&) { what(); };
  return p;
}

TEST(Tool, ErrorsAreOneLineAndACode) {
  const Result r = throwing([] { throw Error(ExitCode::mismatch, "a.glb", "made\nelsewhere"); }).run({});
  EXPECT_EQ(r.code, 4);
  EXPECT_EQ(r.err, "phos-test: a.glb: made elsewhere\n");
  EXPECT_EQ(throwing([] { throw Error(ExitCode::numerical, "", "x"); }).run({}).err, "phos-test: x\n");
  EXPECT_EQ(throwing([] { throw Error(ExitCode::interrupted, "", "x"); }).run({}).code, 130);
}

TEST(Tool, OtherExceptionsAreReportedToo) {
  const Result memory = throwing([] { throw std::bad_alloc(); }).run({});
  EXPECT_EQ(memory.code, 6);
  EXPECT_EQ(memory.err.find("phos-test: out of memory"), 0u);
  EXPECT_TRUE(test::is_one_line(memory.err));
  const Result other = throwing([] { throw std::runtime_error("odd"); }).run({});
  EXPECT_EQ(other.code, 3);
  EXPECT_EQ(other.err.find("phos-test: internal error: odd"), 0u);
}

TEST(Tool, AnswerNoIsAnExitCode) {
  Program p;
  p.output = Tool::Output::none;
  p.body = [](Tool& tool) { tool.set_exit(ExitCode::check_failed); };
  const Result r = p.run({});
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(r.err, "");
}

TEST(Tool, HelpAndVersionAreDataOnStdout) {
  for (const char* option : {"--help", "--version", "--man", "--options-json"}) {
    const Result r = Program().run({option});
    EXPECT_EQ(r.code, 0) << option;
    EXPECT_FALSE(r.worked);
    EXPECT_EQ(r.err, "");
    EXPECT_NE(r.out.find("test"), std::string::npos);
  }
  const std::string help = Program().run({"--help"}).out;
  for (const char* option : {"--threads", "--seed", "--output", "--stats", "--progress", "--quiet",
                             "--verbose", "--reuse", "--why"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
  Program none;
  none.output = Tool::Output::none;
  EXPECT_EQ(none.run({"--help"}).out.find("--reuse"), std::string::npos);
}

TEST(Tool, OutputIsRequiredAndCheckedBeforeTheWork) {
  const Folder f("output");
  const Result absent = Program().run({f.scene()});
  EXPECT_EQ(absent.code, 2);
  EXPECT_TRUE(test::is_one_line(absent.err)) << absent.err;
  EXPECT_EQ(Program().run({f.scene(), "-o", ""}).code, 2);
  for (const std::string& bad : {f.path + "/none/out", f.path, f.scene() + "/out"}) {
    const Result r = Program().run({f.scene(), "-o", bad});
    EXPECT_EQ(r.code, 3) << bad;
    EXPECT_FALSE(r.worked);
    EXPECT_TRUE(test::is_one_line(r.err)) << r.err;
  }
  const Result stats = Program().run({f.scene(), "-o", f.out(), "--stats", f.path + "/none/s.json"});
  EXPECT_EQ(stats.code, 3);
  EXPECT_FALSE(stats.worked);
}

TEST(Tool, ReuseWorksOnlyWhenSomethingDiffers) {
  const Folder f("reuse");
  const std::vector<std::string> command{f.scene(), "-o", f.out(), "--reuse"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return more;
  };
  EXPECT_TRUE(Program().run(command).worked);
  const Result again = Program().run(command);
  EXPECT_EQ(again.code, 0);
  EXPECT_FALSE(again.worked);
  EXPECT_EQ(again.err, "phos-test: " + f.out() + ": up to date\n");
  EXPECT_EQ(Program().run(with({"--quiet"})).err, "");
  EXPECT_FALSE(Program().run(with({"--threads", "1"})).worked);
  EXPECT_FALSE(Program().run(with({"--accuracy", "0.20"})).worked);

  EXPECT_TRUE(Program().run(with({"--accuracy", "0.1"})).worked);
  EXPECT_TRUE(Program().run(with({"--seed", "1"})).worked);
  EXPECT_TRUE(Program().run(command).worked);
  Program newer;
  newer.algorithm = 2;
  EXPECT_TRUE(newer.run(command).worked);
  EXPECT_FALSE(newer.run(command).worked);
  test::spill(f.scene(), "scene two");
  EXPECT_TRUE(newer.run(command).worked);
  EXPECT_FALSE(newer.run(command).worked);
  EXPECT_TRUE(newer.run({f.scene(), "-o", f.out()}).worked);  // not asked to reuse
}

TEST(Tool, ReuseMakesDamagedOutputsAnew) {
  const Folder f("damaged");
  const std::vector<std::string> command{f.scene(), "-o", f.out(), "--reuse"};
  Program().run(command);
  const std::string whole = test::slurp(f.out());
  for (const std::size_t n : {std::size_t{0}, std::size_t{20}, whole.size() - 1}) {
    test::spill(f.out(), whole.substr(0, n));
    EXPECT_TRUE(Program().run(command).worked) << n;
    EXPECT_EQ(test::slurp(f.out()), whole);
  }
}

TEST(Tool, ShardsAreNotTheWhole) {
  const Folder f("shards");
  const std::vector<std::string> command{f.scene(), "-o", f.out(), "--reuse"};
  Program whole, shard;
  shard.variant = "shard 1/4";
  whole.run(command);
  const std::string key = Container::open(f.out()).provenance().key;
  EXPECT_TRUE(shard.run(command).worked);
  EXPECT_EQ(Container::open(f.out()).provenance().key, key + ":shard 1/4");
  EXPECT_FALSE(shard.run(command).worked);
  EXPECT_TRUE(whole.run(command).worked);
}

TEST(Tool, WhyNamesEachDifferenceAndDoesNothing) {
  const Folder f("why");
  const std::vector<std::string> command{f.scene(), "-o", f.out()};
  const auto why = [&](Program p, std::vector<std::string> more) {
    more.insert(more.begin(), {f.scene(), "-o", f.out(), "--why"});
    const Result r = p.run(more);
    EXPECT_EQ(r.code, 0);
    EXPECT_FALSE(r.worked);
    return r.out;
  };
  EXPECT_EQ(why({}, {}), f.out() + ": not there\n");
  Program().run(command);
  const std::string before = test::slurp(f.out());
  EXPECT_EQ(why({}, {}), f.out() + ": nothing differs\n");
  EXPECT_EQ(why({}, {"--accuracy", "0.1"}), f.out() + ": parameter accuracy: 0.2 -> 0.1\n");
  Program newer;
  newer.algorithm = 2;
  EXPECT_EQ(why(newer, {}), f.out() + ": tool algorithm: 1 -> 2\n");
  test::spill(f.path + "/more", "x");
  EXPECT_EQ(why({}, {f.path + "/more"}), f.out() + ": input scene.2: new\n");
  test::spill(f.scene(), "scene two");
  EXPECT_EQ(why({}, {}), f.out() + ": input scene: changed\n");
  EXPECT_EQ(test::slurp(f.out()), before);
}

TEST(Differences, SkipWhatIsFoundWhileWorking) {
  Provenance then, now;
  then.tool = "phos-a 1", now.tool = "phos-b 1";
  then.parameters["radius"] = 0.5, now.parameters["radius"] = Json();
  then.parameters["old"] = 1, now.parameters["new"] = 2;
  then.inputs["photons"] = "x";
  EXPECT_EQ(differences(then, now),
            (std::vector<std::string>{"tool: phos-a 1 -> phos-b 1", "parameter new: absent -> 2",
                                      "parameter old: 1 -> absent", "input photons: no longer given"}));
}

TEST(Tool, ProvenanceReaderServesOtherFormats) {
  const Folder f("reader");
  Program p;
  Provenance stored;
  p.body = [&](Tool& tool) {
    stored = tool.provenance(FileKind::image, "", {});
    test::spill(tool.output(), "no container");
  };
  p.provenance_reader = [&](const std::string&) -> std::optional<Provenance> { return stored; };
  const std::vector<std::string> command{f.scene(), "-o", f.out(), "--reuse"};
  EXPECT_TRUE(p.run(command).worked);
  EXPECT_FALSE(p.run(command).worked);
  EXPECT_EQ(p.run({f.scene(), "-o", f.out(), "--why"}).out, f.out() + ": nothing differs\n");
  EXPECT_NE(p.run({f.scene(), "-o", f.out(), "--why", "--seed", "4"}).out.find("seed: 0 -> 4"),
            std::string::npos);
  EXPECT_TRUE(p.run({f.scene(), "-o", f.out(), "--reuse", "--seed", "4"}).worked);
}

// The key is that of the question, not of the automatic values found while answering it.
TEST(Tool, AutomaticParametersDoNotChangeTheKey) {
  const std::string folder = test::scratch("tool-automatic"), out = folder + "/out";
  int works = 0;
  const auto run = [&] {
    Tool tool("phos-test", "tests", "Tests.", 1);
    std::optional<double> radius;
    tool.options().number("radius", radius, "METRES", "found from the photons if not given");
    const char* argv[] = {"phos-test", "-o", out.c_str(), "--reuse", "--quiet"};
    EXPECT_EQ(tool.run(5, argv,
                       [&] {
                         if (tool.up_to_date()) return;
                         ++works;
                         radius = 0.25;
                         Program::write(tool, FileKind::irradiance);
                       }),
              0);
  };
  run(), run();
  EXPECT_EQ(works, 1);
  EXPECT_EQ(Container::open(out).provenance().parameters.find("radius")->as_number(), 0.25);
}

TEST(Tool, ProvenanceSaysHowItWasMade) {
  const Folder f("provenance");
  EXPECT_EQ(Program().run({f.scene(), "-o", f.out(), "--accuracy", "0.3", "--threads", "2"}).code, 0);
  const Provenance p = Container::open(f.out(), FileKind::irradiance).provenance();
  EXPECT_EQ(p.tool, std::string("phos-test ") + version());
  EXPECT_EQ(p.algorithm, 1);
  EXPECT_EQ(p.parameters.find("accuracy")->as_number(), 0.3);
  EXPECT_EQ(p.parameters.find("seed")->as_integer(), 0);
  for (const char* volatile_name : {"threads", "output", "quiet", "reuse", "stats", "progress"})
    EXPECT_EQ(p.parameters.find(volatile_name), nullptr) << volatile_name;
  EXPECT_EQ(p.inputs.at("scene"), hash_text("scene one").hex());
  EXPECT_EQ(p.command.find(f.path), std::string::npos) << p.command;
  EXPECT_EQ(p.scene_hash, "scene-hash");
  EXPECT_EQ(p.key.size(), 32u);
}

TEST(Tool, BytesDoNotDependOnThreadsOrPaths) {
  const Folder f("bytes"), g("bytes-elsewhere");
  Program().run({f.scene(), "-o", f.out(), "--threads", "1"});
  Program().run({g.scene(), "-o", g.out(), "--threads", "3", "--quiet"});
  EXPECT_EQ(test::slurp(f.out()), test::slurp(g.out()));
}

TEST(Tool, HistoryHoldsEachEarlierStageOnce) {
  const Folder f("history");
  const std::string a = f.path + "/a", b = f.path + "/b", c = f.path + "/c";
  Program().run({f.scene(), "-o", a});
  Program().run({a, "-o", b, "--seed", "1"});
  Program().run({a, b, "-o", c, "--seed", "2"});
  const Json::Array history = Container::open(c).provenance().history.as_array();
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(*history[0].find("key"), Json(Container::open(a).provenance().key));
  EXPECT_EQ(*history[1].find("key"), Json(Container::open(b).provenance().key));
  EXPECT_EQ(history[1].find("inputs")->find("scene")->as_string(), hash_file(a).hex());
}

TEST(Tool, SeveralFilesAreOneInput) {
  const Folder f("several");
  test::spill(f.path + "/b", "texture");
  const auto input = [&](const std::vector<std::string>& paths) {
    Tool tool("phos-test", "tests", "Tests.", 1, Tool::Output::none);
    tool.add_input("scene", paths);
    return tool.provenance(FileKind::image, "", {}).inputs.at("scene");
  };
  const std::string both = input({f.scene(), f.path + "/b"});
  EXPECT_NE(both, input({f.path + "/b", f.scene()}));
  EXPECT_NE(both, input({f.scene()}));
  test::spill(f.path + "/b", "other texture");
  EXPECT_NE(both, input({f.scene(), f.path + "/b"}));
  EXPECT_THROW(input({f.path + "/none"}), Error);
}

TEST(Tool, StatsAreJson) {
  const Folder f("stats");
  Program p;
  p.body = [](Tool& tool) {
    const Tool::Timer timer = tool.time("work");
    tool.counters().add("rejected sample", 3);
    tool.stat("photons", 17);
    Program::write(tool, FileKind::irradiance);
  };
  const std::string stats = f.path + "/stats.json";
  EXPECT_EQ(p.run({f.scene(), "-o", f.out(), "--stats", stats, "--threads", "2"}).code, 0);
  const Json s = parse_json(test::slurp(stats), stats);
  EXPECT_EQ(s.find("photons")->as_integer(), 17);
  EXPECT_EQ(s.find("threads")->as_integer(), 2);
  EXPECT_EQ(s.find("counters")->find("rejected sample")->as_integer(), 3);
  EXPECT_GE(s.find("seconds.total")->as_number(), s.find("seconds.work")->as_number());
  EXPECT_GT(s.find("peak_memory_bytes")->as_integer(), 1000000);
  EXPECT_EQ(s.find("exit_code")->as_integer(), 0);
}

TEST(Tool, SayIsQuietAndWarnIsNot) {
  const Folder f("say");
  Program p;
  p.body = [](Tool& tool) { tool.say("hello"), tool.warn("careful"); };
  EXPECT_EQ(p.run({"-o", f.out()}).err, "phos-test: hello\nphos-test: warning: careful\n");
  EXPECT_EQ(p.run({"-o", f.out(), "--quiet"}).err, "phos-test: warning: careful\n");
}

}  // namespace
}  // namespace phos
