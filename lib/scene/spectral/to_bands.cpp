#include "scene/spectral/to_bands.h"

#include <optional>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "scene/material/merl.h"
#include "scene/material/models.h"
#include "scene/sky/environment.h"
#include "scene/spectral/band_spectra.h"
#include "scene/spectral/bands.h"
#include "scene/spectral/reflectance.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kChunk = 1024;
/// Of a lamp's lumens: a band with less would be refused as too faint, and changes nothing.
constexpr double kLeastShare = 1e-12;

class ToBands {
 public:
  ToBands(Scene& scene, const BandOptions& options)
      : scene_(scene),
        spectra_(scene, options),
        bands_(static_cast<int>(options.number)),
        colours_(bands_, static_cast<int>(options.triplet)) {
    scene.bands = {bands_.size(), colours_.triplet()};
  }

  void convert() {
    for (Light& light : scene_.light)
      light.intensity = light_of(light.intensity, spectra_.of_light(light.name));
    convert_luminaires();
    for (std::size_t i = 0; i < scene_.material.size(); ++i) convert_material(i);
    convert_textures();
    if (!scene_.colour.empty())
      parallel_for(scene_.colour.size(), kChunk, [&, &colours = table()](std::size_t i) {
        Vec4& c = scene_.colour[i];
        c = Vec4(colours.reflectance(Rgb(c)), c.w);
      });
    for (auto& measured : scene_.measured)
      measured = std::make_shared<const MerlBrdf>(
          measured->recoloured([&colours = table()](const Rgb& c) { return colours.reflectance(c); }));
    if (scene_.environment) convert_environment();
  }

 private:
  const BandColourTable& table() {
    if (!table_) table_.emplace(colours_);
    return *table_;
  }

  /// Light of luminance 1 with a spectrum. A part that is less than floats can add to the rest is left out.
  Rgb share_of(const Spectrum& power) {
    DVec3 shares = bands_.triplet_of(bands_.luminous_shares(power), colours_.triplet());
    for (int c = 0; c < 3; ++c) {
      if (!(shares[c] > 0 && shares[c] < kLeastShare)) continue;
      shares[c] = 0;
      ++scene_.events["bands in which a lamp has too little of its lumens (1e-12), left dark"];
    }
    return Rgb(light_of_shares(shares));
  }
  Rgb light_of(const Rgb& rgb, const Spectrum* power) {
    return power ? luminance(rgb) * share_of(*power) : colours_.light(rgb);
  }
  Rgb reflectance_of(const Rgb& rgb, const Spectrum* spectrum) const {
    if (!spectrum) return colours_.reflectance(rgb);
    return Rgb(bands_.triplet_of(bands_.means(*spectrum), colours_.triplet()));
  }

  void convert_luminaires() {
    std::vector<const Spectrum*> spectrum(scene_.fitting.size(), nullptr);
    for (const Light& light : scene_.light)
      if (light.fitting >= 0)
        spectrum[static_cast<std::size_t>(light.fitting)] = spectra_.of_light(light.name);
    for (const Instance& i : scene_.instance)
      if (i.fitting >= 0) spectrum[static_cast<std::size_t>(i.fitting)] = spectra_.of_light(i.node);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
      Fitting& fitting = scene_.fitting[i];
      fitting.set_colour(light_of(fitting.colour(), spectrum[i]));
    }
  }

  void convert_material(std::size_t i) {
    Material& m = scene_.material[i];
    m.emission = light_of(m.emission, spectra_.of_emission(i));
    const Spectrum* spectrum = spectra_.of_reflectance(i);
    const bool polished = row_of(m).spectrum_is_of_ks;
    const bool conserving = max_component(m.kd + m.ks) <= 1.0001f;
    m.kd = reflectance_of(m.kd, polished ? nullptr : spectrum);
    m.ks = reflectance_of(m.ks, polished ? spectrum : nullptr);
    m.specular_colour = colours_.reflectance(m.specular_colour);
    if (m.diffuse_transmission > 0)
      m.diffuse_transmission_colour = colours_.reflectance(m.diffuse_transmission_colour);
    if (m.tint != Rgb(1)) m.tint = colours_.reflectance(m.tint);
    if (m.inside != Rgb(1)) m.inside = colours_.reflectance(m.inside);
    if (m.absorption_per_m != Rgb(0)) convert_absorption(m);
    if (row_of(m).adds_ks && conserving) cut(m);
  }

  /// By the colour that is left of white light after one metre.
  static constexpr float kLeast = 1e-30f;
  void convert_absorption(Material& m) {
    Rgb left = colours_.reflectance(Rgb(std::exp(-m.absorption_per_m.x), std::exp(-m.absorption_per_m.y),
                                        std::exp(-m.absorption_per_m.z)));
    for (int c = 0; c < 3; ++c) m.absorption_per_m[c] = left[c] > kLeast ? -std::log(left[c]) : kInfinity;
  }

  void cut(Material& m) {
    const Rgb most = glm::max(Rgb(1) - m.ks, Rgb(0));
    for (int c = 0; c < 3; ++c) {
      if (!(m.kd[c] > most[c])) continue;
      m.kd[c] = most[c];
      ++scene_.events["bands in which kd + ks was cut to 1"];
    }
  }

  void convert_textures() {
    std::vector<bool> colour(scene_.texture.size(), false);
    for (const Material& m : scene_.material)
      for (const TextureUse* use : {&m.base_colour, &m.emissive, &m.diffuse_transmission_colour_map})
        if (use->used()) colour[static_cast<std::size_t>(use->texture)] = true;
    for (std::size_t t = 0; t < colour.size(); ++t) {
      if (!colour[t]) continue;
      Texture& texture = scene_.texture[t];
      std::vector<Vec4> texels(texture.size());
      parallel_for(texels.size(), kChunk, [&, &colours = table()](std::size_t i) {
        const Vec4 texel = texture.texel(i);
        texels[i] = Vec4(colours.reflectance(Rgb(texel)), texel.w);
      });
      texture.texels = std::move(texels), texture.codes.clear();
    }
  }

  void convert_environment() {
    const Environment& from = *scene_.environment;
    const Spectrum* spectrum = spectra_.of_environment();
    const Rgb share = spectrum ? share_of(*spectrum) : Rgb(0);
    std::vector<Rgb> texels = from.texels();
    const BandColourTable* colours = spectrum ? nullptr : &table();
    parallel_for(texels.size(), kChunk, [&](std::size_t i) {
      texels[i] = spectrum ? luminance(texels[i]) * share : colours->light(texels[i]);
    });
    std::optional<Environment::Sun> sun = from.sun();
    if (sun) sun->illuminance_lx = light_of(sun->illuminance_lx, spectrum);
    Environment to(from.width(), from.height(), std::move(texels), from.rotation_rad(), sun);
    if (!from.recipe().empty()) {
      const Rgb white = spectrum ? share : colours_.white_light();
      to.set_recipe(text(from.recipe(), "; white light ", shortest(white.x), " ", shortest(white.y), " ",
                         shortest(white.z)));
    }
    scene_.environment = std::make_shared<const Environment>(std::move(to));
  }

  Scene& scene_;
  BandSpectra spectra_;
  Bands bands_;
  BandColours colours_;
  std::optional<BandColourTable> table_;
};

}  // namespace

void to_bands(Scene& scene, const BandOptions& options) { ToBands(scene, options).convert(); }

}  // namespace phos::inline scene
