#include "scene/spectral/join_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "image/image_provenance.h"
#include "scene/spectral/bands.h"
#include "scene/spectral/join_parts.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kChunk = 1 << 14;

BandTriplet triplet_in(const Json& parameters, const std::string& path) {
  const Json *bands = parameters.find("bands"), *triplet = parameters.find("triplet");
  if (!bands || !triplet || !bands->is_number() || !triplet->is_number())
    throw Error(ExitCode::bad_input, path,
                "is a picture in RGB; give pictures made with --bands and --triplet");
  const double n = bands->as_number(), k = triplet->as_number();
  const BandTriplet out{n <= Bands::kMost ? static_cast<int>(std::fmax(n, 0)) : 0,
                        k <= Bands::kMost ? static_cast<int>(std::fmax(k, 0)) : 0};
  if (out.number < Bands::kLeast)
    throw Error(ExitCode::bad_input, path, text("says it is of ", n, " bands; make it again"));
  return out;
}

Provenance provenance_of(const std::string& path) {
  std::optional<Provenance> p = read_image_provenance(path);
  if (!p || !p->parameters.is_object())
    throw Error(ExitCode::bad_input, path,
                "does not say how it was made; give pictures of phos-splat or phos-reference");
  return *p;
}

/// All but the triplet is the same.
void require_alike(const Provenance& a, const std::string& a_path, const Provenance& b,
                   const std::string& b_path) {
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::mismatch, b_path, text(what, " than ", a_path, "; give pictures of one run"));
  };
  if (a.tool != b.tool) fail(text("was made by another program (", b.tool, ")"));
  const auto scene = [](const Provenance& p) {
    const auto it = p.inputs.find("scene");
    return it == p.inputs.end() ? std::string() : it->second;
  };
  if (scene(a) != scene(b)) fail("is of another scene, or of other spectra,");
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const auto& [name, value] : from->parameters.as_object()) {
      const Json* other = to->parameters.find(name);
      if (name != "triplet" && (!other || !(*other == value))) fail(text("was made with another --", name));
    }
}

bool is_error(const std::string& layer) { return layer.find("stderr") != std::string::npos; }

/// Sums of a layer of all pictures.
class Joiner {
 public:
  Joiner(const Bands& bands, int width, int height) : bands_(bands), image_(width, height) {}

  void add(const Image& part, int triplet) {
    std::set<std::string> coloured;
    for (const std::string& layer : part.layers()) {
      add_layer(layer, part, triplet);
      for (const char* c : {"R", "G", "B"}) coloured.insert(channel_name(layer, c));
    }
    for (const auto& [name, values] : part.channels())
      if (!coloured.count(name)) add_channel(name, values);
  }

  Image image() {
    for (const auto& [layer, sums] : sums_) {
      std::vector<Rgb> values(sums.begin(), sums.end());
      const std::vector<DVec3>& squares = squares_[layer];
      for (std::size_t i = 0; i < squares.size(); ++i)
        values[i] = Rgb(glm::max(glm::abs(sums[i]), glm::sqrt(squares[i])));
      image_.set_rgb(layer, values);
    }
    return std::move(image_);
  }

  void leave_out(const std::string& layer) { sums_.erase(layer); }

  /// The first channel that differs among parts.
  const std::string& differs() const { return differs_; }

 private:
  void add_layer(const std::string& layer, const Image& part, int triplet) {
    DVec3 column[3];
    for (int c = 0; c < 3; ++c) {
      column[c] = bands_.rgb_of(triplet, c);
      if (layer == "albedo" && bands_.band_of(triplet, c) >= 0)
        column[c] = rgb_of_xyz(bands_.white_xyz(bands_.band_of(triplet, c)));
    }
    const std::vector<Rgb> values = part.rgb(layer);
    std::vector<DVec3>&sums = sums_[layer], &squares = squares_[layer];
    sums.resize(values.size(), DVec3(0));
    if (is_error(layer)) squares.resize(values.size(), DVec3(0));
    parallel_for(values.size(), kChunk, [&](std::size_t i) {
      for (int c = 0; c < 3; ++c) {
        const DVec3 term = static_cast<double>(values[i][c]) * column[c];
        sums[i] += term;
        if (!squares.empty()) squares[i] += term * term;
      }
    });
  }

  void add_channel(const std::string& name, const std::vector<float>& values) {
    const bool known = image_.has(name);
    const std::span<float> out = image_.channel(name);
    if (!known) {
      std::copy(values.begin(), values.end(), out.begin());
    } else if (name.starts_with("illuminance")) {
      for (std::size_t i = 0; i < values.size(); ++i) out[i] += values[i];
    } else if (name == "weight.Y") {
      for (std::size_t i = 0; i < values.size(); ++i) out[i] = std::min(out[i], values[i]);
    } else if (differs_.empty() && !std::equal(values.begin(), values.end(), out.begin(), same)) {
      differs_ = name;
    }
  }
  static bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

  const Bands& bands_;
  Image image_;
  std::map<std::string, std::vector<DVec3>> sums_, squares_;  // the second of errors
  std::string differs_;
};

}  // namespace

JoinedPicture join_pictures(const BandParts& parts) {
  std::vector<Provenance> made;
  for (const std::string& path : parts.paths) made.push_back(provenance_of(path));
  const std::vector<int> order =
      order_of(parts, [&](std::size_t i) { return triplet_in(made[i].parameters, parts.paths[i]); });
  for (std::size_t i = 1; i < made.size(); ++i)
    require_alike(made[0], parts.paths[0], made[i], parts.paths[i]);

  const Bands bands(triplet_in(made[0].parameters, parts.paths[0]).number);
  std::optional<Joiner> joiner;
  std::string first;
  int width = 0, height = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (order[k] < 0) continue;
    const std::string& path = parts.paths[static_cast<std::size_t>(order[k])];
    const Image part = read_image(path);
    if (!joiner) joiner.emplace(bands, width = part.width(), height = part.height()), first = path;
    if (part.width() != width || part.height() != height)
      throw Error(
          ExitCode::mismatch, path,
          text("is not ", width, " x ", height, " pixels like ", first, "; give pictures of one size"));
    joiner->add(part, static_cast<int>(k) + 1);
    if (!joiner->differs().empty())
      throw Error(ExitCode::mismatch, path,
                  text("has another ", joiner->differs(), " than ", first, "; give pictures of one view"));
  }
  if (!parts.dark.empty()) joiner->leave_out("albedo");
  JoinedPicture out{joiner->image(), bands.size(), 0};
  if (out.image.has_layer(""))
    for (const Rgb& c : out.image.rgb("")) out.beyond += std::min({c.x, c.y, c.z}) < 0;
  return out;
}

}  // namespace phos::inline scene
