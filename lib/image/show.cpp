#include "image/show.h"

#include "core/interrupt.h"
#include "core/text/append_item.h"
#include "file/atomic_file.h"
#include "file/frames.h"
#include "image/events.h"
#include "image/metrics.h"
#include "image/pixel_table.h"
#include "image/video.h"

namespace phos::inline image {
namespace {

std::size_t write_hdr_layer(const std::string& path, const Image& image, const std::string& layer) {
  const std::vector<Rgb> colours = layer_colours(image, layer);
  Image out(image.width(), image.height());
  out.attributes = image.attributes;
  out.set_rgb("", colours);
  write_hdr(path, out);
  std::size_t non_finite = 0;
  for (const Rgb& c : colours) non_finite += is_finite(c) ? 0 : 1;
  return non_finite;
}

void tell_non_finite(Tool& tool, const std::string& input, const Image& image, std::size_t n, bool hdr) {
  if (n == 0) return;
  tool.counters().count(kNonFinitePixelEvent, n);
  tool.warn(text(input, ": ", n, " of ", image.pixels(), " pixels are not finite; they are ",
                 hdr ? "black" : "magenta"));
}

/// What the first frame that is not black decides.
bool expose(const Tool& tool, const Image& image, std::int64_t frame, LayerPictureOptions& p) {
  const LayerPictureOptions asked = p;
  p = fixed_exposure(image, p);
  if (p.min != asked.min || p.max != asked.max)
    tool.say(text("all frames have the colours of frame ", frame, ": --min ", shortest(*p.min), " --max ",
                  shortest(*p.max)));
  if (p.tone.key_cd_m2 != asked.tone.key_cd_m2 || p.tone.white_cd_m2 != asked.tone.white_cd_m2)
    tool.say(text("all frames are exposed as frame ", frame, ": --key ", shortest(*p.tone.key_cd_m2),
                  " --white ", shortest(*p.tone.white_cd_m2)));
  if (!p.contours.of.empty() && p.contours.levels.empty()) {
    p.contours = fixed_levels(image, p.contours);
    std::string levels;
    for (const std::string& level : p.contours.levels) append_item(levels, level, ",");
    if (levels.empty()) return false;
    tool.say(text("all frames have the lines of frame ", frame, ": --levels ", levels));
  }
  return p.false_colour ? p.max.has_value() : p.tone.white_cd_m2.has_value();
}

void draw_contours(Tool& tool, const Image& image, const std::string& input, const ContourOptions& contours,
                   Picture& picture) {
  ContouredPicture drawn = contoured(image, picture, contours);
  picture = std::move(drawn.picture);
  if (drawn.unlabelled.empty()) return;
  std::string levels;
  for (const double level : drawn.unlabelled) append_item(levels, shortest(level));
  tool.warn(text(input, ": lines of ", levels, " have no room for a label"));
}

}  // namespace

std::optional<Picture> show_image(Tool& tool, const Image& image, const std::string& input,
                                  const std::string& output, const LayerPictureOptions& p) {
  if (output.ends_with(".hdr")) {
    const std::size_t non_finite = write_hdr_layer(output, image, layer_from_label(p.layer));
    tell_non_finite(tool, input, image, non_finite, true);
    return std::nullopt;
  }
  if (output.ends_with(".csv")) {
    AtomicFile file(output);
    file.write(pixel_csv(image, layer_from_label(p.layer)));
    file.commit();
    return std::nullopt;
  }
  ToneMapped shown = layer_picture(image, p);
  if (tool.verbose() && !p.false_colour)
    tool.say(text("middle grey ", shown.key_cd_m2, " cd/m2, white ", shown.white_cd_m2, " cd/m2"));
  tell_non_finite(tool, input, image, shown.non_finite, false);
  if (!p.contours.of.empty()) draw_contours(tool, image, input, p.contours, shown.picture);
  return std::move(shown.picture);
}

void show_sequence(Tool& tool, const PictureSequence& s, LayerPictureOptions p) {
  const FrameRange range = parse_frames(s.frames);
  const bool video = is_video(tool.output());
  const FramePattern inputs = existing_sequence(s.input, range, "INPUT");
  const FramePattern outputs = video ? FramePattern("", "") : sequence_pattern(tool.output(), range, "-o");
  p.steady = true;
  std::optional<VideoFile> film;
  bool exposed = tool.output().ends_with(".hdr");
  Progress progress("pictures", static_cast<std::uint64_t>(range.count()), "frames");
  for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
    throw_if_interrupted();
    const std::string input = inputs.path(frame);
    const Image image = read_image(input);
    if (!exposed) exposed = expose(tool, image, frame, p);
    if (const auto picture = show_image(tool, image, input, outputs.path(frame), p)) {
      const double rate = s.frames_per_s.value_or(frames_per_s(image).value_or(24));
      if (video && !film) film.emplace(tool.output(), picture->width, picture->height, rate);
      if (video)
        film->add(*picture);
      else
        write_png(outputs.path(frame), *picture);
    }
    progress.advance();
  }
  if (film) film->commit();
}

}  // namespace phos::inline image
