#include "image/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json.h"
#include "file/mapped_file.h"

extern char** environ;

namespace phos::inline image {
namespace {

struct Format {
  std::string_view ending;
  const char* muxer;
  std::vector<std::string> codec;
};

const Format* format_of(const std::string& path) {
  const std::vector<std::string> h264{"-c:v", "libx264", "-preset", "medium", "-crf", "16"};
  static const Format kFormats[] = {
      {".mp4", "mp4", h264},
      {".mkv", "matroska", h264},
      {".webm", "webm", {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"}},
  };
  for (const Format& f : kFormats)
    if (path.ends_with(f.ending)) return &f;
  return nullptr;
}

std::vector<std::string> command(const std::string& path, const std::string& out, int width, int height,
                                 double frames_per_s) {
  const Format& format = *format_of(path);
  std::vector<std::string> words{
      "ffmpeg", "-loglevel", "error", "-y",
      // Raw pictures on its standard input ...
      "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", text(width, 'x', height), "-framerate",
      shortest(frames_per_s), "-i", "pipe:0",
      // ... to the format that every player shows.
      "-vf",
      "crop=floor(iw/2)*2:floor(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,"
      "format=yuv420p",
      "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv",
      "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"};
  words.insert(words.end(), format.codec.begin(), format.codec.end());
  if (format.ending == ".mp4") words.insert(words.end(), {"-movflags", "+faststart"});
  words.insert(words.end(), {"-f", format.muxer, out});
  return words;
}

std::string last_line(std::FILE* file) {
  std::rewind(file);
  std::string line, last;
  for (int c; (c = std::fgetc(file)) != EOF;) {
    if (c != '\n')
      line += static_cast<char>(c);
    else if (!line.empty())
      last = std::move(line), line.clear();
  }
  return line.empty() ? last : line;
}

}  // namespace

bool is_video(const std::string& path) { return format_of(path) != nullptr; }

VideoFile::VideoFile(const std::string& path, int width, int height, double frames_per_s)
    : path_(path), width_(width), height_(height), file_(path), messages_(std::tmpfile(), std::fclose) {
  PHOS_CHECK(is_video(path), path);
  if (file_.temporary().empty())
    throw Error(ExitCode::bad_input, path, "is no place for a video; choose the name of a file");
  if (!messages_)
    throw Error(
        ExitCode::bad_input, path,
        text("no temporary file can be made: ", system_message(errno), "; set TMPDIR to another folder"));
  start(file_.temporary(), frames_per_s);
}

void VideoFile::start(const std::string& temporary, double frames_per_s) {
  std::vector<std::string> words = command(path_, temporary, width_, height_, frames_per_s);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(ExitCode::bad_input, "ffmpeg", "cannot be started: " + system_message(errno) + "; try again");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(messages_.get()), 2);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is for us: we stop ffmpeg
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  const int error = ::posix_spawnp(&ffmpeg_, "ffmpeg", &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[0]);
  input_ = ends[1];
  if (error == 0) return;
  ffmpeg_ = -1;
  stop_input();
  if (error == ENOENT)
    throw Error(ExitCode::bad_input, "ffmpeg",
                "is not installed, and makes the videos; install the Debian package ffmpeg, or write "
                "pictures: -o film/%04d.png");
  throw Error(ExitCode::bad_input, "ffmpeg",
              "cannot be started: " + system_message(error) + "; reinstall it");
}

void VideoFile::stop_input() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

int VideoFile::wait() {
  int status = 0;
  while (::waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) continue;
  ffmpeg_ = -1;
  return status;
}

VideoFile::~VideoFile() {
  if (ffmpeg_ > 0) {
    ::kill(ffmpeg_, SIGKILL);
    wait();
  }
  stop_input();
}

void VideoFile::fail() {
  const std::string why = last_line(messages_.get());
  throw Error(ExitCode::bad_input, path_,
              text("ffmpeg could not make the video: ", why.empty() ? "it ended without a reason" : why,
                   "; write pictures instead: -o film/%04d.png"));
}

void VideoFile::add(const Picture& picture) {
  if (picture.width != width_ || picture.height != height_)
    throw Error(ExitCode::mismatch, path_,
                text("a frame is ", picture.width, " x ", picture.height, " pixels, the first was ", width_,
                     " x ", height_, "; render all frames at one size"));
  const std::uint8_t* at = picture.rgb.data();
  std::size_t left = picture.rgb.size();
  while (left > 0) {
    const ssize_t n = ::write(input_, at, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      wait();  // it has closed its input: it has ended, or is about to
      fail();
    }
    at += n, left -= static_cast<std::size_t>(n);
  }
}

void VideoFile::commit() {
  stop_input();
  const int status = wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
  file_.commit();
}

}  // namespace phos::inline image
