// Pictures one after another as a video, by the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "file/atomic_file.h"
#include "image/image.h"

namespace phos::inline image {

/// Does the name end as a video that VideoFile writes (.mp4, .mkv: H.264; .webm: VP9)?
bool is_video(const std::string& path);

/// A video that appears whole or not at all. sRGB, BT.709 at video range, 4:2:0; an odd last row or column is
/// left out. Encoded on one thread, so that the bytes do not depend on the machine's cores (they do on the
/// version of ffmpeg).
class VideoFile {
 public:
  /// Starts ffmpeg. Throws Error(bad_input) if it is not installed, or nothing can be written at `path`.
  VideoFile(const std::string& path, int width, int height, double frames_per_s);
  /// Without commit(): stops ffmpeg and leaves the file at `path`.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// The next frame, of the size of the first. Throws Error(bad_input), with ffmpeg's reason, if it has
  /// failed.
  void add(const Picture& picture);
  void commit();

 private:
  void start(const std::string& temporary, double frames_per_s);
  void stop_input();
  int wait();
  [[noreturn]] void fail();

  /// An ffmpeg that has ended is then an error of write().
  struct NoSigpipe {
    void (*before)(int) = std::signal(SIGPIPE, SIG_IGN);
    ~NoSigpipe() { std::signal(SIGPIPE, before); }
  };
  std::string path_;
  int width_, height_;
  AtomicFile file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;  ///< messages of ffmpeg
  NoSigpipe no_sigpipe_;
  int input_ = -1;
  pid_t ffmpeg_ = -1;
};

}  // namespace phos::inline image
