#include "image/image.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/parallel.h"
#include "file/atomic_file.h"
#include "file/lfs_pointer.h"
#include "image/exr/decode.h"
#include "image/exr/encode.h"
#include "image/hdr.h"
#include "image/png.h"

namespace phos::inline image {

namespace {

constexpr std::string_view kExrMagic{"\x76\x2f\x31\x01", 4};

void write_file(const std::string& path, const std::string& bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace

std::span<float> Image::channel(const std::string& name) {
  std::vector<float>& values = channels_[name];
  values.resize(pixels());
  return values;
}

std::optional<double> frames_per_s(const Image& image) {
  const auto found = image.attributes.find(kFramesPerSecond);
  if (found == image.attributes.end()) return std::nullopt;
  const std::string& s = found->second;
  double rate = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), rate);
  if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(rate) || !(rate > 0))
    return std::nullopt;
  return rate;
}

std::string channel_name(const std::string& layer, const std::string& component) {
  return layer.empty() ? component : layer + "." + component;
}

bool Image::has_layer(const std::string& layer) const {
  return has(channel_name(layer, "R")) && has(channel_name(layer, "G")) && has(channel_name(layer, "B"));
}

std::vector<Rgb> Image::rgb(const std::string& layer) const {
  const std::span<const float> r = channel(channel_name(layer, "R")), g = channel(channel_name(layer, "G")),
                               b = channel(channel_name(layer, "B"));
  std::vector<Rgb> values(pixels());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {r[i], g[i], b[i]};
  return values;
}

void Image::set_rgb(const std::string& layer, std::span<const Rgb> values) {
  PHOS_CHECK(values.size() == pixels(), values.size(), " values for ", pixels(), " pixels");
  std::vector<float>* const to[] = {&channels_[channel_name(layer, "R")],
                                    &channels_[channel_name(layer, "G")],
                                    &channels_[channel_name(layer, "B")]};
  parallel_for(3, 1, [&](std::size_t c) {
    to[c]->resize(pixels());
    for (std::size_t i = 0; i < values.size(); ++i) (*to[c])[i] = values[i][static_cast<int>(c)];
  });
}

std::vector<std::string> Image::layers() const {
  std::vector<std::string> names;
  if (has_layer("")) names.emplace_back();
  for (const auto& [name, values] : channels_) {
    if (!name.ends_with(".R")) continue;
    const std::string layer = name.substr(0, name.size() - 2);
    if (has_layer(layer)) names.push_back(layer);
  }
  return names;
}

bool is_image(std::string_view bytes) { return bytes.starts_with(kExrMagic) || bytes.starts_with("#?"); }

bool is_named_image(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".exr" || extension == ".hdr";
}

Image read_image(const std::string& path) {
  const std::string bytes = read_text(path);
  if (bytes.starts_with(kExrMagic)) return decode_exr(bytes, path);
  if (bytes.starts_with("#?")) return decode_hdr(bytes, path);
  throw Error(ExitCode::bad_input, path,
              text("neither an OpenEXR nor a Radiance .hdr image",
                   is_lfs_pointer(bytes) ? text(", but ", kLfsPointer) : "; convert it to one of these"));
}

void write_exr(const std::string& path, const Image& image, ExrCompression compression) {
  write_file(path, encode_exr(image, compression));
}
void write_hdr(const std::string& path, const Image& image) { write_file(path, encode_hdr(image)); }
void write_png(const std::string& path, const Picture& picture) { write_file(path, encode_png(picture)); }
Picture read_png(const std::string& path) { return decode_png(read_text(path), path); }

}  // namespace phos::inline image
