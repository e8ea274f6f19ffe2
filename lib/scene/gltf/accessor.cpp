#include "scene/gltf/accessor.h"

#include <tiny_gltf.h>

#include <cstring>
#include <functional>

namespace phos::inline scene {
namespace {

/// An accessor without bytes of its own is all zeros. It belongs to others that have some (a vertex that a
/// target moves has a position), so that it cannot be larger than this and the bytes there are.
constexpr std::uint64_t kZeroElements = 1u << 16;

struct View {
  const unsigned char* data = nullptr;  ///< null: zeros
  std::size_t stride = 0;
};

std::size_t component_size(const GltfDocument& document, int type, const std::string& where) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      document.fail(text(where, ".componentType is ", type, ", which glTF does not have"));
  }
}

/// `count` elements of `size` bytes from `offset` in a buffer view, all inside it.
View locate(const GltfDocument& document, int view_index, std::size_t offset, std::size_t count,
            std::size_t size, const std::string& where) {
  const tinygltf::BufferView& view = document.model->bufferViews[static_cast<std::size_t>(view_index)];
  const std::string& buffer = document.buffer[static_cast<std::size_t>(view.buffer)];
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    document.fail(
        text("bufferViews[", view_index, "] reaches outside its buffer of ", buffer.size(), " bytes"));
  }
  const std::size_t stride = view.byteStride ? view.byteStride : size;
  if (stride < size)
    document.fail(text("bufferViews[", view_index, "].byteStride is shorter than an element"));
  const auto* base = reinterpret_cast<const unsigned char*>(buffer.data()) + view.byteOffset;
  if (count == 0) return {base, stride};
  const bool inside = offset <= view.byteLength && size <= view.byteLength - offset &&
                      (count - 1) <= (view.byteLength - offset - size) / stride;
  if (!inside) document.fail(text(where, " reaches outside bufferViews[", view_index, "]"));
  return {base + offset, stride};
}

template <class T>
T load(const unsigned char* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

float to_float(const unsigned char* p, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto v = static_cast<float>(load<std::int8_t>(p));
      return normalized ? std::fmax(v / 127.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto v = static_cast<float>(load<std::uint8_t>(p));
      return normalized ? v / 255.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto v = static_cast<float>(load<std::int16_t>(p));
      return normalized ? std::fmax(v / 32767.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto v = static_cast<float>(load<std::uint16_t>(p));
      return normalized ? v / 65535.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<float>(load<std::uint32_t>(p));
    default:
      return load<float>(p);
  }
}

std::uint32_t to_index(const unsigned char* p, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load<std::uint8_t>(p);
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(p);
  return load<std::uint32_t>(p);
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Calls put(element, bytes) for each element, then again for those that a sparse accessor replaces.
void for_each_element(const GltfDocument& document, int index, int components,
                      const std::function<void(std::size_t, const unsigned char*)>& put) {
  const tinygltf::Accessor& accessor = document.model->accessors[static_cast<std::size_t>(index)];
  const std::string where = text("accessors[", index, "]");
  if (accessor_components(document, index) != components) {
    document.fail(text(where, " must have ", components, " components"));
  }
  const std::size_t size =
      component_size(document, accessor.componentType, where) * static_cast<std::size_t>(components);
  if (accessor.bufferView >= 0) {
    const View view = locate(document, accessor.bufferView, accessor.byteOffset, accessor.count, size, where);
    for (std::size_t i = 0; i < accessor.count; ++i) put(i, view.data + i * view.stride);
  } else {
    const std::vector<unsigned char> zeros(size);
    for (std::size_t i = 0; i < accessor.count; ++i) put(i, zeros.data());
  }
  if (!accessor.sparse.isSparse) return;
  const auto count = static_cast<std::size_t>(accessor.sparse.count);
  const int type = accessor.sparse.indices.componentType;
  if (!is_index_type(type)) document.fail(where + ".sparse.indices.componentType is not an unsigned integer");
  const View at = locate(document, accessor.sparse.indices.bufferView,
                         static_cast<std::size_t>(accessor.sparse.indices.byteOffset), count,
                         component_size(document, type, where), where + ".sparse.indices");
  const View values = locate(document, accessor.sparse.values.bufferView,
                             static_cast<std::size_t>(accessor.sparse.values.byteOffset), count, size,
                             where + ".sparse.values");
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t target = to_index(at.data + i * at.stride, type);
    if (target >= accessor.count) {
      document.fail(text(where, ".sparse.indices holds ", target, ", but count is ", accessor.count));
    }
    put(target, values.data + i * values.stride);
  }
}

/// Elements of the accessor, bounded by the bytes there are before anything of that size is allocated.
std::size_t element_count(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model->accessors[static_cast<std::size_t>(index)];
  const std::string where = text("accessors[", index, "]");
  if (accessor.bufferView < 0) {
    std::uint64_t most = kZeroElements;
    for (const std::string& buffer : document.buffer) most += buffer.size();
    if (accessor.count > most) {
      document.fail(text(where, " has no bufferView and a count of ", accessor.count,
                         ", more than the buffers have bytes; export the scene again"));
    }
    return accessor.count;
  }
  const std::size_t size = component_size(document, accessor.componentType, where);
  locate(document, accessor.bufferView, accessor.byteOffset, accessor.count, size, where);
  return accessor.count;
}

}  // namespace

int accessor_components(const GltfDocument& document, int accessor) {
  const int type = document.model->accessors[static_cast<std::size_t>(accessor)].type;
  return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
}

std::vector<float> read_floats(const GltfDocument& document, int accessor, int components) {
  const tinygltf::Accessor& a = document.model->accessors[static_cast<std::size_t>(accessor)];
  const auto n = static_cast<std::size_t>(components);
  const std::size_t size = component_size(document, a.componentType, text("accessors[", accessor, "]"));
  std::vector<float> values(element_count(document, accessor) * n);
  for_each_element(document, accessor, components, [&](std::size_t i, const unsigned char* p) {
    for (std::size_t c = 0; c < n; ++c)
      values[i * n + c] = to_float(p + c * size, a.componentType, a.normalized);
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor, int components) {
  const tinygltf::Accessor& a = document.model->accessors[static_cast<std::size_t>(accessor)];
  if (!is_index_type(a.componentType))
    document.fail(text("accessors[", accessor, "] must hold unsigned integers"));
  const auto n = static_cast<std::size_t>(components);
  const std::size_t size = component_size(document, a.componentType, text("accessors[", accessor, "]"));
  std::vector<std::uint32_t> values(element_count(document, accessor) * n);
  for_each_element(document, accessor, components, [&](std::size_t i, const unsigned char* p) {
    for (std::size_t c = 0; c < n; ++c) values[i * n + c] = to_index(p + c * size, a.componentType);
  });
  return values;
}

}  // namespace phos::inline scene
