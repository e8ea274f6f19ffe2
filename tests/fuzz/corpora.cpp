// Small files of every kind that phos writes or reads, for the fuzzers to begin with: fuzz_corpora FOLDER
// fills FOLDER/<fuzzer>/.
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/random.h"
#include "image/exr/encode.h"
#include "image/hdr.h"
#include "image/png.h"
#include "photon/photon_map.h"
#include "photon/photon_shards.h"
#include "place/parts.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/table.h"
#include "support/films.h"
#include "support/gltf.h"
#include "support/run.h"
#include "temporal/film/file.h"
#include "temporal/journal.h"
#include "view/message/writer.h"

namespace phos {
namespace {

std::string folder(const std::string& root, const std::string& fuzzer) {
  std::filesystem::create_directories(root + "/" + fuzzer);
  return root + "/" + fuzzer + "/";
}

Photons some_photons(std::size_t n) {
  Photons p;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(1, Stage::test, i);
    p.position.push_back({random.uniform(), random.uniform(), i % 3 == 0 ? 0 : random.uniform()});
    p.flux.push_back(Rgb(random.uniform()));
    p.direction.push_back(encode_octahedral(sample_uniform_sphere(random.uniform2())));
    p.normal.push_back(encode_octahedral({0, 1, 0})), p.source_normal.push_back(encode_octahedral({1, 0, 0}));
    p.distance.push_back(random.uniform());
    p.path.push_back(static_cast<std::uint8_t>(i % 3)), p.bounce.push_back(1);
  }
  return p;
}

void photons(const std::string& to) {
  for (const std::size_t n : {0u, 1u, 5u, 20u, 60u}) {
    PhotonTotals totals;
    totals.emitted = totals.stored = totals.paths = n;
    const std::string name = text(to, n, ".photons");
    PhotonMap::build(some_photons(n), totals).write(name, test::irradiance_provenance());
    write_shard(name + ".shard", some_photons(n), totals, "1/1", test::irradiance_provenance());
  }
}

void irradiance(const std::string& to) {
  for (const std::size_t n : {0u, 1u, 4u, 12u}) {
    const IrradianceCache cache = test::random_cache(n);
    const std::string name = text(to, n, ".irradiance");
    write_irradiance(name, cache, test::irradiance_provenance());
    const RecordIndex index = index_records(cache.records, reading_accuracy(cache.accuracy));
    test::write_indexed(name + ".indexed", name, index);
    IrradiancePart part;
    part.name = "1/1", part.total = n, part.whole = cache, part.whole.records.clear();
    part.bounds = {0.01f, 1}, part.scene = {Vec3(0), Vec3(1)};
    for (const IrradianceRecord& r : cache.records) {
      Made made;
      made.record = r, made.least_radius_m = 0.01f;
      part.made.push_back(made);
    }
    write_part(name + ".part", part, test::irradiance_provenance());
  }
}

void radiance_files(const std::string& to) {
  write_radiance(to + "none.radiance", test::random_radiance(0, 3), test::radiance_provenance());
  write_radiance(to + "same.radiance", test::random_radiance(3, 2), test::radiance_provenance());
  write_radiance(to + "compact.radiance", test::random_radiance({3, 2}), test::radiance_provenance(),
                 Store::compact);
  RadianceCache shaped = test::random_radiance(3, 2);
  for (RadianceRecord& r : shaped.records) r.footprint_m.emplace().fill(0.5f);
  write_radiance(to + "shaped.radiance", shaped, test::radiance_provenance());
  write_radiance(to + "orders.radiance", test::random_radiance({1, 3, 2}), test::radiance_provenance());
}

void brdf(const std::string& to) {
  write_brdf(to + "none.brdf", {}, test::irradiance_provenance());
  for (const bool isotropic : {true, false}) {
    BrdfTable table;
    table.material = "paint", table.isotropic = isotropic;
    table.resolution = 3, table.order = 2, table.albedo = 0.5f;
    const std::size_t entries = isotropic ? 3 : 9;
    table.orders.assign(entries, 2), table.error.assign(entries, 0.01f);
    table.coefficients.assign(entries * 4 * 3, 0.1f);
    BrdfTable traced = table;
    traced.order = 0, traced.orders.assign(entries, 0), traced.coefficients.clear();
    write_brdf(text(to, isotropic, ".brdf"), std::vector{table, traced}, test::irradiance_provenance());
  }
}

void films(const std::string& to) {
  for (const TemporalGradients g :
       {TemporalGradients::none, TemporalGradients::extrapolated, TemporalGradients::interpolated})
    for (const bool anchored : {false, true}) {
      const std::string name = text(to, name_of(g), anchored);
      write_film(name + ".irradiance", test::random_film(4, anchored, g), test::irradiance_provenance());
      RadianceFilm radiance = test::random_radiance_film({1, 2, 1}, anchored, g);
      if (anchored) test::add_footprints(radiance);
      write_film(name + ".radiance", radiance, test::radiance_provenance());
    }
}

/// Estimates made of nothing, irradiance and radiance, some with a look ahead.
struct Estimates : Estimator {
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Worker>(); }
  Made make(const RecordSite& site, Worker& worker) const override {
    Made made;
    made.record = test::random_cache(4).records[site.item % 4];
    if (site.item % 2) {
      RadianceRecord radiance = test::random_radiance(1, 2).records[0];
      if (site.item % 4 == 1) radiance.footprint_m.emplace().fill(0.5f);
      made.radiance = std::make_shared<RadianceRecord>(radiance);
    }
    if (site.item % 3) made.ahead = std::make_shared<Ahead>(Ahead{made.record, made.radiance, 0.1f});
    worker.counters.add("records probed");
    return made;
  }
};

void journals(const std::string& to) {
  for (const std::uint64_t n : {0u, 1u, 6u}) {
    EstimateJournal journal(text(to, n, ".journal"), "key", false);
    const Estimates estimates;
    const JournalEstimator estimator(estimates, journal, 0);
    const auto worker = estimator.make_worker();
    for (std::uint64_t i = 0; i < n; ++i) estimator.make({Vec3(0), {0, 0, 1}, i}, *worker);
  }
}

Image small_image(int width, int height) {
  Image image(width, height);
  RandomStream random(3, Stage::test, 1);
  for (const char* name : {"R", "G", "B", "Z"})
    for (float& v : image.channel(name)) v = 100 * random.uniform();
  image.attributes["phos.key"] = "0123456789abcdef";
  return image;
}

void images(const std::string& root) {
  for (const ExrCompression c : {ExrCompression::none, ExrCompression::zip, ExrCompression::piz})
    for (const char* fuzzer : {"exr", "environment"})
      test::spill(text(folder(root, fuzzer), static_cast<int>(c), ".exr"), encode_exr(small_image(8, 4), c));
  for (const char* fuzzer : {"hdr", "environment"}) {
    test::spill(folder(root, fuzzer) + "flat.hdr", encode_hdr(small_image(4, 2)));
    test::spill(folder(root, fuzzer) + "runs.hdr", encode_hdr(small_image(16, 8)));
  }
  Picture picture{6, 5, {}};
  for (int i = 0; i < 3 * 6 * 5; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(7 * i));
  for (const char* fuzzer : {"png", "texture"})
    test::spill(folder(root, fuzzer) + "small.png", encode_png(picture));
  std::string targa(18, '\0');
  targa[2] = 2, targa[12] = 2, targa[14] = 2, targa[16] = 24;
  test::spill(folder(root, "texture") + "small.tga", targa + std::string(12, 'c'));
  targa[2] = 10;
  test::spill(folder(root, "texture") + "runs.tga", targa + "\x83" + "rgb");
  std::string bitmap("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30);
  bitmap.resize(54);
  test::spill(folder(root, "texture") + "small.bmp", bitmap + std::string(16, 'c'));
}

void scenes(const std::string& to) {
  test::Gltf g;
  Json m;
  m["emissiveFactor"] = Json::Array{1, 0.5, 0.2};
  m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 20;
  m["extras"]["phos"]["brdf"] = "phong";
  m["extras"]["phos"]["kd"] = Json::Array{0.3, 0.3, 0.3},
  m["extras"]["phos"]["ks"] = Json::Array{0.3, 0.3, 0.3};
  m["extras"]["phos"]["exponent"] = 22;
  g.square_node(m);
  Json sparse;
  sparse["componentType"] = 5126, sparse["count"] = 4, sparse["type"] = "VEC3";
  sparse["sparse"]["count"] = 1;
  sparse["sparse"]["indices"]["bufferView"] = g.view(std::vector<std::uint16_t>{2});
  sparse["sparse"]["indices"]["componentType"] = 5123;
  sparse["sparse"]["values"]["bufferView"] = g.view(std::vector<float>{0, 0, 1});
  g.json["accessors"].push_back(sparse);
  Json target;
  target["POSITION"] = static_cast<int>(g.size("accessors")) - 1;
  Json p = g.square();
  p["targets"] = Json::Array{target};
  Json n;
  n["mesh"] = g.mesh(p), n["weights"] = Json::Array{0.5}, n["rotation"] = Json::Array{0, 0, 0, 1};
  n["name"] = "moving";
  const int node = g.node(n);
  Json lamp;
  lamp["type"] = "spot", lamp["intensity"] = 100, lamp["spot"]["outerConeAngle"] = 0.7;
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{lamp};
  Json light;
  light["extensions"]["KHR_lights_punctual"]["light"] = 0, light["translation"] = Json::Array{0, 0, 2};
  g.node(light);
  Json camera;
  camera["type"] = "perspective", camera["perspective"]["yfov"] = 0.8;
  g.json["cameras"] = Json::Array{camera};
  Json eye;
  eye["camera"] = 0;
  g.node(eye);
  Json sampler;
  sampler["input"] = g.scalars({0, 1}), sampler["output"] = g.vec3({0, 0, 0, 1, 1, 1});
  sampler["interpolation"] = "LINEAR";
  Json channel;
  channel["sampler"] = 0, channel["target"]["node"] = node, channel["target"]["path"] = "translation";
  Json animation;
  animation["samplers"] = Json::Array{sampler}, animation["channels"] = Json::Array{channel};
  g.json["animations"] = Json::Array{animation};
  test::spill(to + "much.glb", g.bytes());
  test::spill(to + "empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}");
  test::spill(
      to + "uri.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
}

void texts(const std::string& root) {
  test::spill(
      folder(root, "obj") + "much.obj",
      "mtllib scene.mtl\no a\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 1\n"
      "usemtl m\ns 1\nf 1/1/1 2/2/1 3//1 -1\ng b\nl 1 2\np 1\nf 1 2 3\n#=mtl\nnewmtl m\nKd 0.5 0.5 0.5\n"
      "Ks 0.2 0.2 0.2\nNs 20\nillum 2\nKe 1 1 1\nmap_Kd -clamp on tex.png\nd 0.5\n#=lights\n"
      R"({"lights":[{"type":"point","position":[0,0,1],"intensity":[10,10,10]}],)"
      R"("cameras":[{"position":[0,0,3],"target":[0,0,0],"yfov":0.8}]})");
  test::spill(folder(root, "csv") + "points.csv",
              "x,y,z,nx,ny,nz,id\n0,0,0,0,0,1,a\n1,1,1,0,1,0,\"b, \"\"c\"\"\"\n");
  test::spill(folder(root, "csv") + "points.txt", "# points\n0 0 0 0 0 1\n1 2 3\t0 0 -1\n");
  test::spill(folder(root, "csv") + "plot.csv", "a [lx],b\r\n1,2\r\n+3e4,-\r\nnan,7\r\n");
  test::spill(
      folder(root, "options") + "all.txt",
      "# settings\nnumber = 5\n--flag\nmaybe 1e-3\ncount=7\nword hello there  # trailing\nmany a,b\nmany c\n"
      "shape disc\n-o x\noutput=y\n");
  test::spill(folder(root, "json") + "all.json", R"({"a":[1,-2.5e3,true,null,"\u00e9\n"],"b":{"c":{}}})");
  test::spill(folder(root, "toml") + "study.toml",
              "[study]\nscenes = \"room.glb\"\nsensors = \"points.csv\"\nrepeats = 3\nwidth = 20\n"
              "confidence = 0.9\ntime = \"cpu\"\n[reference]\nseeds = [1, 2]\n[[reference.given]]\n"
              "scene = \"room.glb\"\nfiles = [\"room.glb\"]\n");
  test::spill(
      folder(root, "toml") + "other.toml",
      "a.b.c = 1\n[x]\nlist = [1, 2.5, \"s\", true, {y = 1}]\nlong = \"\"\"\nab\"\"\"\nd = 1979-05-27\n");
}

void merl(const std::string& to) {
  const std::int32_t sizes[3] = {90, 90, 180};
  const double samples[] = {100, 200, -1, 50, 0, 1e3, 5, 1};
  std::string bytes(sizeof sizes, '\0');
  std::memcpy(bytes.data(), sizes, sizeof sizes);
  test::spill(to + "short", bytes + '\0');
  bytes += '\1';
  test::spill(to + "full", bytes + std::string(reinterpret_cast<const char*>(samples), sizeof samples));
}

/// Of each kind, with one row in every table, and with none.
void messages(const std::string& to) {
  for (const MessageLayout& layout : message_layouts()) {
    MessageWriter filled(layout.kind);
    for (const MessageField& field : layout.fields) {
      if (field.table == "distribution") continue;  // a quarter of a megabyte
      if (field.type == FieldType::f32)
        filled.add(field.table, field.name, std::vector<float>(field.components, 0.5f));
      else if (field.type == FieldType::u32)
        filled.add(field.table, field.name, std::vector<std::uint32_t>(field.components, 0));
      else
        filled.add(field.table, field.name, std::vector<std::uint8_t>(field.components, 'a'));
    }
    test::spill(text(to, layout.name), filled.message());
    test::spill(text(to, layout.name, ".empty"), MessageWriter(layout.kind).message());
  }
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fuzz_corpora FOLDER\n"), 2;
  const std::string root = argv[1];
  using namespace phos;
  photons(folder(root, "photons")), irradiance(folder(root, "irradiance")),
      radiance_files(folder(root, "radiance"));
  brdf(folder(root, "brdf")), films(folder(root, "film")), journals(folder(root, "journal")),
      scenes(folder(root, "gltf"));
  images(root), texts(root), merl(folder(root, "merl")), messages(folder(root, "message"));
}
