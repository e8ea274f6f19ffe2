// phos-info as a user drives it.
#include <gtest/gtest.h>

#include "core/error.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "file/kinds/tensor_io.h"
#include "support/container.h"
#include "support/run.h"

namespace phos {
namespace {

using test::run_tool;

struct Sample {
  Sample() : folder(test::scratch("info")), path(folder + "/a.photons") {
    test::SampleColumns().writer().write(path, test::sample_provenance());
  }
  std::string folder, path;
};

TEST(Info, NoArgumentsHelpAndVersion) {
  const test::Run none = run_tool({"info"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.out, "");
  EXPECT_TRUE(test::is_one_line(none.err)) << none.err;
  const test::Run help = run_tool({"info", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* option : {"--json", "--dump", "--points", "--verify", "--canonical"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  EXPECT_EQ(run_tool({"info", "--version"}).out.find("phos-info "), 0u);
  EXPECT_EQ(run_tool({"info", "--nonsense"}).code, 2);
  EXPECT_EQ(run_tool({"info", Sample().path, "--json", "--verify"}).code, 2);
}

TEST(Info, PrintsTextJsonTablesAndPoints) {
  const Sample s;
  const test::Run human = run_tool({"info", s.path});
  EXPECT_EQ(human.code, 0);
  EXPECT_EQ(human.err, "");
  EXPECT_NE(human.out.find("phos-photons --photons 5"), std::string::npos);
  const Json json = parse_json(run_tool({"info", s.path, "--json"}).out, "");
  EXPECT_EQ(json.find("kind")->as_string(), "photons");
  EXPECT_EQ(json.find("tensors")->as_object().size(), 11u);
  EXPECT_EQ(run_tool({"info", s.path, "--dump", "path"}).out, "path\n0\n1\n2\n1\n0\n");
  EXPECT_EQ(run_tool({"info", s.path, "--dump", "path,position"}).out.find("path,position.x"), 0u);
  EXPECT_EQ(run_tool({"info", s.path, "--points"}).out.find("ply\nformat ascii"), 0u);
  EXPECT_NE(run_tool({"info", s.path, "--canonical"}).out.find("algorithm 3"), std::string::npos);
  const std::string ply = s.folder + "/points.ply";
  EXPECT_EQ(run_tool({"info", s.path, "--points", "--ply", "binary", "-o", ply}).code, 0);
  EXPECT_EQ(test::slurp(ply).find("ply\nformat binary_little_endian"), 0u);
}

TEST(Info, SameTextOnAnyNumberOfThreads) {
  const std::string path = test::scratch("info-threads") + "/a";
  std::vector<float> values(1000000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.f / static_cast<float>(1 + i % 977);
  ContainerWriter writer;
  writer.add<float>("v", values, {values.size()}, "m");
  writer.write(path, test::sample_provenance());
  const std::string one = run_tool({"info", path, "--json", "--threads", "1"}).out;
  EXPECT_EQ(run_tool({"info", path, "--json", "--threads", "4"}).out, one);
  EXPECT_NE(one, "");
}

/// Photons of a shard, for which a file needs no tree; a tensor may be left out.
void write_shard(const std::string& path, const std::string& without) {
  const std::vector<Vec3> three(2, Vec3(1));
  const std::vector<std::uint32_t> codes(2);
  const std::vector<std::uint8_t> bytes(2);
  const std::vector<float> lengths(2);
  TensorWriter writer(FileKind::photons);
  for (const char* name : {"position", "flux"})
    if (name != without) writer.add_vectors(name, three);
  for (const char* name : {"direction", "normal", "source_normal"})
    if (name != without) writer.add<std::uint32_t>(name, codes);
  for (const char* name : {"path", "bounce"})
    if (name != without) writer.add<std::uint8_t>(name, bytes);
  if (without != "distance") writer.add<float>("distance", lengths);
  Provenance provenance;
  provenance.extra[name_of(FileForm::shard)] = "1/2";
  writer.write(path, provenance);
}

TEST(Info, VerifyTellsWhichTensorIsNoneOfItsKind) {
  const Sample s;
  const std::string path = s.folder + "/shard";
  write_shard(path, "");
  EXPECT_EQ(run_tool({"info", "--verify", path}).code, 0);
  for (const char* name : {"position", "flux", "bounce", "distance"}) {
    write_shard(path, name);
    const test::Run r = run_tool({"info", "--verify", "--verbose", path});
    EXPECT_EQ(r.code, 3);
    EXPECT_NE(r.err.find(text(path, ": has no tensor \"", name, '"')), std::string::npos) << r.err;
  }
}

TEST(Info, VerifyIsSilent) {
  const Sample s;
  write_shard(s.path, "");
  const test::Run good = run_tool({"info", "--verify", s.path});
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(good.out + good.err, "");
  std::string bytes = test::slurp(s.path);
  bytes[bytes.size() - 3] ^= 1;
  const std::string bad = s.folder + "/bad";
  test::spill(bad, bytes);
  const test::Run damaged = run_tool({"info", "--verify", bad});
  EXPECT_EQ(damaged.code, 3);
  EXPECT_EQ(damaged.out + damaged.err, "");
  EXPECT_NE(run_tool({"info", "--verify", "--verbose", bad}).err.find("has changed"), std::string::npos);
  EXPECT_EQ(run_tool({"info", "--verify", s.folder + "/none"}).code, 3);
}

TEST(Info, BadInputsAreOneLine) {
  const Sample s;
  const std::string bytes = test::slurp(s.path), path = s.folder + "/x";
  std::vector<std::string> contents{"", "a text file\n", std::string(1000, '\xff'), bytes + "x"};
  for (std::size_t n = 1; n < bytes.size(); n += 97) contents.push_back(bytes.substr(0, n));
  for (const std::string& c : contents) {
    test::spill(path, c);
    const test::Run r = run_tool({"info", path});
    EXPECT_EQ(r.code, 3) << c.size();
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(test::is_one_line(r.err)) << r.err;
    EXPECT_EQ(r.err.find("phos-info: " + path + ": "), 0u) << r.err;
  }
  for (const std::string& missing : {s.folder + "/none", s.folder}) {
    const test::Run r = run_tool({"info", missing});
    EXPECT_EQ(r.code, 3);
    EXPECT_TRUE(test::is_one_line(r.err)) << r.err;
  }
}

TEST(Info, OutputThatCannotBeWritten) {
  const Sample s;
  for (const std::string& out : {s.folder + "/none/x", s.folder, std::string("/dev/full")}) {
    const test::Run r = run_tool({"info", s.path, "--json", "-o", out});
    EXPECT_EQ(r.code, 3) << out;
    EXPECT_TRUE(test::is_one_line(r.err)) << r.err;
  }
}

TEST(Info, UnknownTensorListsThoseThereAre) {
  const Sample s;
  const test::Run r = run_tool({"info", s.path, "--dump", "colour"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("flux"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace phos
