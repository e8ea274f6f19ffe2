#include "scene/gltf/mesh.h"

#include <tiny_gltf.h>

#include <algorithm>

#include "scene/gltf/accessor.h"

namespace phos::inline scene {
namespace {

template <class V>
std::vector<V> as_vectors(const std::vector<float>& values) {
  constexpr auto kWidth = static_cast<std::size_t>(V::length());
  std::vector<V> out(values.size() / kWidth);
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t c = 0; c < kWidth; ++c) out[i][static_cast<int>(c)] = values[i * kWidth + c];
  }
  return out;
}

class PrimitiveReader {
 public:
  PrimitiveReader(const GltfDocument& document, std::size_t mesh, std::size_t primitive)
      : document_(document),
        from_(document.model->meshes[mesh].primitives[primitive]),
        place_(text("meshes[", mesh, "].primitives[", primitive, "]")) {}

  std::optional<MeshData> read(const std::vector<float>& weights) {
    const int mode = from_.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from_.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES || !from_.attributes.count("POSITION")) return std::nullopt;
    data_.position = vectors<Vec3>("POSITION");
    if (data_.position.empty()) return std::nullopt;
    data_.normal = vectors<Vec3>("NORMAL");
    data_.tangent = vectors<Vec4>("TANGENT");
    data_.uv0 = vectors<Vec2>("TEXCOORD_0");
    data_.uv1 = vectors<Vec2>("TEXCOORD_1");
    read_colour();
    data_.deforms = !from_.targets.empty();
    blend_targets(weights);
    read_triangles(mode);
    return std::move(data_);
  }

 private:
  template <class V>
  std::vector<V> vectors(const std::map<std::string, int>& attributes, const char* name) const {
    const auto it = attributes.find(name);
    if (it == attributes.end()) return {};
    std::vector<V> out = as_vectors<V>(read_floats(document_, it->second, static_cast<int>(V::length())));
    if (!data_.position.empty() && out.size() != data_.position.size()) {
      document_.fail(
          text(place_, ".", name, " has ", out.size(), " entries for ", data_.position.size(), " vertices"));
    }
    return out;
  }
  template <class V>
  std::vector<V> vectors(const char* name) const {
    return vectors<V>(from_.attributes, name);
  }

  void read_colour() {
    const auto it = from_.attributes.find("COLOR_0");
    if (it == from_.attributes.end()) return;
    if (accessor_components(document_, it->second) == 4) {
      data_.colour = vectors<Vec4>("COLOR_0");
      return;
    }
    for (const Vec3& c : vectors<Vec3>("COLOR_0")) data_.colour.emplace_back(c, 1.0f);
  }

  void blend_targets(const std::vector<float>& weights) {
    const std::size_t n = std::min(weights.size(), from_.targets.size());
    for (std::size_t t = 0; t < n; ++t) {
      const std::vector<Vec3> position = vectors<Vec3>(from_.targets[t], "POSITION");
      const std::vector<Vec3> normal = vectors<Vec3>(from_.targets[t], "NORMAL");
      for (std::size_t i = 0; i < position.size(); ++i) data_.position[i] += weights[t] * position[i];
      if (data_.normal.empty()) continue;
      for (std::size_t i = 0; i < normal.size(); ++i) data_.normal[i] += weights[t] * normal[i];
    }
  }

  void read_triangles(int mode) {
    std::vector<std::uint32_t> index;
    if (from_.indices >= 0) {
      index = read_indices(document_, from_.indices);
    } else {
      index.resize(data_.position.size());
      for (std::uint32_t i = 0; i < index.size(); ++i) index[i] = i;
    }
    for (const std::uint32_t v : index) {
      if (v >= data_.position.size()) {
        document_.fail(
            text(place_, ".indices holds ", v, ", but there are ", data_.position.size(), " vertices"));
      }
    }
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      for (std::size_t i = 0; i + 2 < index.size(); i += 3) add(index[i], index[i + 1], index[i + 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 0; i + 2 < index.size(); ++i)
        add(index[i], index[i + 1 + i % 2], index[i + 2 - i % 2]);
    } else {
      for (std::size_t i = 1; i + 1 < index.size(); ++i) add(index[i], index[i + 1], index[0]);
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { data_.triangle.push_back({{a, b, c}}); }

  const GltfDocument& document_;
  const tinygltf::Primitive& from_;
  std::string place_;
  MeshData data_;
};

}  // namespace

std::optional<MeshData> read_primitive(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                       const std::vector<float>& weights) {
  return PrimitiveReader(document, mesh, primitive).read(weights);
}

bool apply_skin(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                const std::vector<glm::dmat4>& joint, MeshData& data) {
  const tinygltf::Primitive& from = document.model->meshes[mesh].primitives[primitive];
  const auto joints = from.attributes.find("JOINTS_0"), weights = from.attributes.find("WEIGHTS_0");
  if (joints == from.attributes.end() || weights == from.attributes.end()) return false;
  const std::vector<std::uint32_t> which = read_indices(document, joints->second, 4);
  const std::vector<float> weight = read_floats(document, weights->second, 4);
  if (which.size() != 4 * data.position.size() || weight.size() != which.size()) {
    document.fail(
        text("meshes[", mesh, "].primitives[", primitive, "] has joints for another number of vertices"));
  }
  for (std::size_t i = 0; i < data.position.size(); ++i) {
    glm::dmat4 m(0);
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
      if (weight[k] == 0) continue;
      if (which[k] >= joint.size())
        document.fail(text("meshes[", mesh, "] uses joint ", which[k], ", which is not there"));
      m += static_cast<double>(weight[k]) * joint[which[k]];
    }
    data.position[i] = Vec3(DVec3(m * glm::dvec4(DVec3(data.position[i]), 1.0)));
    if (!data.normal.empty()) data.normal[i] = Vec3(DVec3(m * glm::dvec4(DVec3(data.normal[i]), 0.0)));
  }
  data.tangent.clear();
  data.deforms = true;
  return true;
}

}  // namespace phos::inline scene
