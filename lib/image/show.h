// What phos-picture does with images: one, or the frames of a sequence.
#pragma once

#include <optional>
#include <string>

#include "file/tool.h"
#include "image/layer_picture.h"

namespace phos::inline image {

/// Returns the picture, with its lines of equal value, or writes it where `output` ends in .hdr, or its
/// numbers where it ends in .csv. Warns of pixels of pictures that are not finite, and of lines without a
/// label; `input` is their file.
std::optional<Picture> show_image(Tool& tool, const Image& image, const std::string& input,
                                  const std::string& output, const LayerPictureOptions& options);

struct PictureSequence {
  std::string input, frames;           ///< a pattern or a folder, and the range
  std::optional<double> frames_per_s;  ///< of a video; else as the first image says, else 24
};

/// Every frame with one exposure, which fits the first frame that is not black: pictures, or a video where
/// the output's name says so. Throws as show_image(), FramePattern and VideoFile do.
void show_sequence(Tool& tool, const PictureSequence& sequence, LayerPictureOptions options);

}  // namespace phos::inline image
