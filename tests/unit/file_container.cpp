// Writing and reading containers; provenance; what a file of another kind, version or scene says.
#include "file/container.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <thread>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/provenance.h"
#include "support/container.h"
#include "support/run.h"

namespace phos {
namespace {

using test::sample_provenance;
using test::SampleColumns;

Error error_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e;
  }
  ADD_FAILURE() << "no error";
  return {ExitCode::done, "", ""};
}

std::string written(const std::string& name) {
  const std::string path = test::scratch("container") + '/' + name;
  SampleColumns().writer().write(path, sample_provenance());
  return path;
}

template <class T>
std::vector<T> vector_of(std::span<const T> s) {
  return {s.begin(), s.end()};
}

TEST(Container, ReadsBackEveryDtype) {
  const SampleColumns c;
  const Container file = Container::open(written("a.photons"), FileKind::photons);
  EXPECT_EQ(file.tensors().size(), 11u);
  EXPECT_EQ(vector_of(file.vectors("position")), c.position);
  EXPECT_EQ(vector_of(file.values<std::uint8_t>("path", {5})), c.path);
  EXPECT_EQ(vector_of(file.values<std::uint16_t>("small", {0})), c.small);
  EXPECT_EQ(vector_of(file.values<std::int32_t>("whole", {0})), c.whole);
  EXPECT_EQ(vector_of(file.values<std::uint32_t>("normal", {0})), c.normal);
  EXPECT_EQ(vector_of(file.values<std::int64_t>("wide", {0})), c.wide);
  EXPECT_EQ(vector_of(file.values<std::uint64_t>("id", {0})), c.id);
  EXPECT_EQ(vector_of(file.values<double>("exact", {0})), c.exact);
  EXPECT_EQ(file.values<float>("gradient", {0, 3, 3}).size(), 45u);
  EXPECT_EQ(file.tensors().at("flux").unit, "lm");
  file.verify();
}

TEST(Container, EmptyTensorsAreLegal) {
  const Container file = Container::open(written("a.photons"));
  EXPECT_TRUE(file.vectors("none").empty());
  const std::string path = test::scratch("container-none") + "/empty.photons";
  Provenance p;
  p.kind = FileKind::photons;
  ContainerWriter().write(path, p);
  EXPECT_TRUE(Container::open(path).tensors().empty());
}

TEST(Container, ValuesAreAlignedAndDataStartOn64Bytes) {
  const std::string path = written("a.photons");
  const Container file = Container::open(path);
  for (const auto& [name, t] : file.tensors())
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(t.bytes.data()) % dtype_size(t.dtype), 0u) << name;
  const std::string bytes = test::slurp(path);
  std::uint64_t length = 0;
  for (int i = 7; i >= 0; --i)
    length = length << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
  EXPECT_EQ((8 + length) % 64, 0u);
}

// The rules of the safetensors format: offsets from 0, contiguous, and to the end of the file.
TEST(Container, IsStrictSafetensors) {
  const std::string bytes = test::slurp(written("a.photons"));
  std::uint64_t length = 0;
  for (int i = 7; i >= 0; --i)
    length = length << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
  const Json header = parse_json(std::string_view(bytes).substr(8, length), "");
  std::map<std::int64_t, std::int64_t> extents;
  for (const auto& [name, entry] : header.as_object()) {
    if (name == "__metadata__") continue;
    const Json::Array& offsets = entry.find("data_offsets")->as_array();
    if (offsets[0].as_integer() < offsets[1].as_integer())
      extents[offsets[0].as_integer()] = offsets[1].as_integer();
  }
  std::int64_t at = 0;
  for (const auto& [begin, end] : extents) {
    EXPECT_EQ(begin, at);
    at = end;
  }
  EXPECT_EQ(8 + length + static_cast<std::uint64_t>(at), bytes.size());
  for (const auto& [name, value] : header.find("__metadata__")->as_object())
    EXPECT_TRUE(value.is_string()) << name;
  EXPECT_EQ(header.find("__metadata__")->find("format")->as_string(), "phos/photons/1");
}

TEST(Container, SameContentsGiveTheSameBytes) {
  const SampleColumns c;
  const std::string folder = test::scratch("container-same");
  c.writer().write(folder + "/a", sample_provenance());
  ContainerWriter other_order;
  other_order.add<float>("none", c.none, {0, 3}, "m");
  other_order.add<float>("gradient", c.gradient, {5, 3, 3}, "lx/m");
  other_order.add<double>("exact", c.exact, {2}, "s");
  other_order.add<std::uint64_t>("id", c.id, {2}, "1");
  other_order.add<std::int64_t>("wide", c.wide, {2}, "1");
  other_order.add<std::int32_t>("whole", c.whole, {3}, "1");
  other_order.add<std::uint16_t>("small", c.small, {3}, "1");
  other_order.add<std::uint8_t>("path", c.path, {5}, "1");
  other_order.add<std::uint32_t>("normal", c.normal, {5}, "octahedral");
  other_order.add_vectors("flux", c.flux, "lm");
  other_order.add_vectors("position", c.position, "m");
  other_order.write(folder + "/b", sample_provenance());
  EXPECT_EQ(test::slurp(folder + "/a"), test::slurp(folder + "/b"));
}

TEST(Container, ProvenanceReadsBack) {
  Provenance p = sample_provenance();
  p.history = Json::Array{history_entry(p)};
  const std::string path = test::scratch("container-provenance") + "/a";
  SampleColumns().writer().write(path, p);
  const Provenance q = Container::open(path).provenance();
  EXPECT_EQ(to_metadata(q), to_metadata(p));
  EXPECT_EQ(q.kind, FileKind::photons);
  EXPECT_EQ(q.algorithm, 3);
  EXPECT_EQ(q.parameters, p.parameters);
  EXPECT_EQ(q.inputs, p.inputs);
  EXPECT_EQ(q.history, p.history);
  EXPECT_EQ(q.extra.find("total_flux")->as_number(), 1.25);
  EXPECT_EQ(q.counters["degenerate triangle"], 2u);
}

TEST(Container, NamesThatAreNotUtf8AreMadeReadable) {
  Provenance p = sample_provenance();
  p.scene_parts["nodes"]["caf\xe9 \xc3\xa9 \xed\xa0\x80"] = "n";
  const std::string path = test::scratch("container-utf8") + "/a";
  SampleColumns().writer().write(path, p);
  const Json parts = Container::open(path).provenance().scene_parts;
  EXPECT_NE(parts.find("nodes")->find("caf\xef\xbf\xbd \xc3\xa9 \xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"),
            nullptr)
      << parts.dump();
}

TEST(Container, CopiesShareTheMapping) {
  auto file = std::make_unique<Container>(Container::open(written("a.photons")));
  const Container copy = *file;
  const Vec3* data = copy.vectors("position").data();
  file.reset();
  EXPECT_EQ(data[1], Vec3(3, 4, 5));
}

TEST(Container, ReadsFromAPipe) {
  const std::string path = written("a.photons");
  const std::string bytes = test::slurp(path), pipe = test::scratch("container-pipe") + "/pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread feeder([&] { test::spill(pipe, bytes); });
  const Container file = Container::open(pipe);
  feeder.join();
  file.verify();
  EXPECT_EQ(vector_of(file.vectors("position")), SampleColumns().position);
}

TEST(Container, WrongTensorsAreNamed) {
  const Container file = Container::open(written("a.photons"));
  EXPECT_NE(std::string(error_of([&] { file.vectors("irradiance"); }).what()).find("\"irradiance\""),
            std::string::npos);
  const Error shape = error_of([&] { file.values<float>("position", {0}); });
  EXPECT_EQ(shape.code(), ExitCode::bad_input);
  EXPECT_NE(std::string(shape.what()).find("is F32[5,3], not F32[n]"), std::string::npos) << shape.what();
  const Error dtype = error_of([&] { file.values<double>("position", {0, 3}); });
  EXPECT_NE(std::string(dtype.what()).find("not F64[n,3]"), std::string::npos) << dtype.what();
}

TEST(Container, AnotherKindNamesBoth) {
  const std::string path = written("a.photons");
  const Error e = error_of([&] { Container::open(path, FileKind::irradiance); });
  EXPECT_EQ(e.code(), ExitCode::bad_input);
  EXPECT_EQ(e.where(), path);
  EXPECT_STREQ(e.what(), "holds photons, not irradiance; give the output of phos-irradiance");
}

TEST(Container, AnotherVersionNamesBoth) {
  Provenance p = sample_provenance();
  p.version = 2;
  const std::string path = test::scratch("container-version") + "/a";
  SampleColumns().writer().write(path, p);
  const Error e = error_of([&] { Container::open(path, FileKind::photons); });
  EXPECT_EQ(e.code(), ExitCode::bad_input);
  EXPECT_NE(std::string(e.what()).find("phos/photons/2"), std::string::npos) << e.what();
  EXPECT_NE(std::string(e.what()).find("phos/photons/1"), std::string::npos) << e.what();
}

TEST(Container, OtherFilesAreNotPhosFiles) {
  const std::string folder = test::scratch("container-other");
  const std::map<std::string, std::string> files{
      {"# a text file\nwith two lines\n", "it is text"},
      {std::string("glTF\2\0\0\0", 8) + std::string(100, '\1'), "it is a glTF scene"},
      {std::string("\x76\x2f\x31\x01\2\0\0\0", 8) + std::string(100, '\0'), "it is an OpenEXR image"},
      {std::string("\x89PNG\r\n\x1a\n", 8) + std::string(100, '\0'), "it is a PNG picture"},
      {"", "is empty"},
      {"short", "not a phos file"},
      {test::container_bytes("{\"a\":{\"dtype\":\"F32\",\"shape\":[0],\"data_offsets\":[0,0]}}"),
       "not a phos file"}};
  for (const auto& [bytes, expected] : files) {
    test::spill(folder + "/x", bytes);
    const Error e = error_of([&] { Container::open(folder + "/x"); });
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find(expected), std::string::npos) << e.what();
    EXPECT_FALSE(is_container(folder + "/x"));
  }
  EXPECT_NE(std::string(error_of([&] { Container::open(folder + "/none"); }).what()).find("No such file"),
            std::string::npos);
  EXPECT_NE(std::string(error_of([&] { Container::open(folder); }).what()).find("folder"), std::string::npos);
  EXPECT_FALSE(is_container(folder + "/none"));
  EXPECT_TRUE(is_container(written("a")));
}

TEST(Container, AFileCutInItsHeaderIsStillOne) {
  const std::string folder = test::scratch("container-cut"), whole = read_text(written("a"));
  for (const std::size_t bytes : {std::size_t{9}, std::size_t{20}, std::size_t{100}, whole.size() - 1}) {
    test::spill(folder + "/x", whole.substr(0, bytes));
    EXPECT_TRUE(is_container(folder + "/x")) << bytes;
    EXPECT_NE(std::string(error_of([&] { Container::open(folder + "/x"); }).what()).find("truncated"),
              std::string::npos);
  }
}

struct ScenePart {
  const char* description;
  std::function<void(Json&)> change;
  const char* expected;
};

TEST(RequireSameScene, NamesWhatChanged) {
  Json parts;
  parts["geometry"] = "g", parts["materials"] = "m", parts["lights"] = "l", parts["time"] = 0.0;
  parts["nodes"]["lamp"] = "1", parts["nodes"]["table"] = "2";
  Provenance p = sample_provenance();
  p.scene_parts = parts;
  const std::string path = test::scratch("same-scene") + "/room.irradiance";
  p.tool = "phos-irradiance 0.1.0";
  SampleColumns().writer().write(path, p);
  const Container file = Container::open(path);
  EXPECT_NO_THROW(require_same_scene(file, "room.glb", p.scene_hash, parts));

  const std::vector<ScenePart> cases{
      {"moved", [](Json& j) { j["nodes"]["lamp"] = "9", j["geometry"] = "9"; }, "node \"lamp\" moved"},
      {"gone",
       [](Json& j) {
         j["nodes"] = Json::Object{{"lamp", "1"}};
       },
       "node \"table\" is gone"},
      {"new", [](Json& j) { j["nodes"]["chair"] = "3"; }, "node \"chair\" is new"},
      {"geometry", [](Json& j) { j["geometry"] = "9"; }, "geometry changed"},
      {"materials", [](Json& j) { j["materials"] = "9"; }, "materials changed"},
      {"lights", [](Json& j) { j["lights"] = "9"; }, "lights changed"},
      {"time", [](Json& j) { j["time"] = 1.5; }, "time 0 s is now 1.5 s"}};
  for (const ScenePart& c : cases) {
    Json now = parts;
    c.change(now);
    const Error e = error_of([&] { require_same_scene(file, "room.glb", "other", now); });
    EXPECT_EQ(e.code(), ExitCode::mismatch) << c.description;
    EXPECT_EQ(e.where(), path);
    EXPECT_EQ(std::string(e.what()), text("made from another scene (room.glb has changed since: ", c.expected,
                                          "); rerun phos-irradiance, or pass --allow-mismatch"));
  }
  const Error unknown = error_of([&] { require_same_scene(file, "room.glb", "other", {}); });
  EXPECT_NE(std::string(unknown.what()).find("(room.glb has changed since)"), std::string::npos)
      << unknown.what();
}

/// A scene of which most nodes are others is no version of the file's.
TEST(RequireSameScene, NamesAnotherScene) {
  const auto scene = [](const char* hash, const std::vector<std::string>& nodes) {
    Json parts;
    parts["geometry"] = hash, parts["materials"] = hash, parts["lights"] = hash, parts["time"] = 0.0;
    for (const std::string& name : nodes) parts["nodes"][name] = hash;
    return parts;
  };
  Provenance p = sample_provenance();
  p.scene_parts = scene("1", {"bed", "chair", "desk", "lamp", "wall"});
  const std::string path = test::scratch("another-scene") + "/room.irradiance";
  SampleColumns().writer().write(path, p);
  const Container file = Container::open(path);
  const auto said = [&](const Json& now) {
    const Error e = error_of([&] { require_same_scene(file, "hall.glb", "other", now); });
    EXPECT_EQ(e.code(), ExitCode::mismatch);
    return std::string(e.what());
  };
  EXPECT_NE(said(scene("2", {"door", "wall"}))
                .find(R"(made from another scene (with nodes "bed", "chair", "desk" and 1 more; )"
                      R"(hall.glb has node "door"); rerun)"),
            std::string::npos);
  EXPECT_NE(said(scene("2", {"bed", "chair", "desk", "lamp", "wall"}))
                .find("(geometry, materials and nodes differ from hall.glb)"),
            std::string::npos);
  Json edited = p.scene_parts;
  edited["geometry"] = "2", edited["materials"] = "2", edited["lights"] = "2", edited["nodes"]["lamp"] = "2";
  EXPECT_NE(said(edited).find("hall.glb has changed since: node \"lamp\" moved"), std::string::npos);
  Json many = scene("2", {});
  EXPECT_NE(said(many).find("(geometry, materials and lights differ from hall.glb)"), std::string::npos);
}

TEST(ContainerDeathTest, OurOwnMistakesAreCaught) {
  const std::vector<float> v(6, 0.f);
  ContainerWriter writer;
  writer.add<float>("v", v, {2, 3}, "m");
  EXPECT_DEATH(writer.add<float>("v", v, {6}, "m"), "added twice");
  EXPECT_DEATH(writer.add<float>("w", v, {5}, "m"), "24 bytes");
}

}  // namespace
}  // namespace phos
