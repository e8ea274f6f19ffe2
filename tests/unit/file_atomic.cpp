// Files appear whole or not at all, whatever fails.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <functional>

#include "core/error.h"
#include "core/interrupt.h"
#include "file/atomic_file.h"
#include "file/container.h"
#include "support/run.h"

namespace phos {
namespace {

std::size_t files_in(const std::string& folder) {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
  return n;
}

std::string message(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_FALSE(e.where().empty());
    return e.what();
  }
  return "";
}

void write_all(const std::string& path, const std::string& s) {
  AtomicFile file(path);
  file.write(s);
  file.commit();
}

TEST(AtomicFile, AppearsOnlyAtCommit) {
  const std::string folder = test::scratch("atomic"), path = folder + "/out";
  AtomicFile file(path);
  file.write("one ");
  EXPECT_FALSE(std::filesystem::exists(path));
  file.write("two");
  file.commit();
  EXPECT_EQ(test::slurp(path), "one two");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, WithoutCommitLeavesWhatWasThere) {
  const std::string folder = test::scratch("atomic-kept"), path = folder + "/out";
  test::spill(path, "before");
  {
    AtomicFile file(path);
    file.write("half of the n");
  }
  EXPECT_EQ(test::slurp(path), "before");
  EXPECT_EQ(files_in(folder), 1u);
  write_all(path, "after");
  EXPECT_EQ(test::slurp(path), "after");
}

TEST(AtomicFile, TwoWritersOfOnePathDoNotMix) {
  const std::string path = test::scratch("atomic-two") + "/out";
  AtomicFile a(path), b(path);
  a.write("aaaa"), b.write("b");
  a.commit();
  EXPECT_EQ(test::slurp(path), "aaaa");
  b.commit();
  EXPECT_EQ(test::slurp(path), "b");
}

TEST(AtomicFile, KeepsRightsAndLinks) {
  const std::string folder = test::scratch("atomic-rights");
  test::spill(folder + "/real", "before");
  ASSERT_EQ(::chmod((folder + "/real").c_str(), 0640), 0);
  std::filesystem::create_symlink("real", folder + "/link");
  write_all(folder + "/link", "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder + "/link"));
  EXPECT_EQ(test::slurp(folder + "/real"), "after");
  struct stat info {};
  ASSERT_EQ(::stat((folder + "/real").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(AtomicFile, FullDeviceIsReported) {
  EXPECT_NE(message([] { write_all("/dev/full", "x"); }).find("No space left"), std::string::npos);
}

/// Files may not grow beyond `bytes` while this lives; a full disk behaves alike.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(AtomicFile, FailureInTheMiddleLeavesWhatWasThere) {
  const std::string folder = test::scratch("atomic-limit"), path = folder + "/out";
  test::spill(path, "before");
  const std::string big(1 << 20, 'x');
  std::string what;
  {
    const SizeLimit limit(100000);
    what = message([&] { write_all(path, big); });
  }
  EXPECT_NE(what.find("cannot write: File too large"), std::string::npos) << what;
  EXPECT_EQ(test::slurp(path), "before");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, ContainerOnAFullDiskLeavesWhatWasThere) {
  const std::string folder = test::scratch("atomic-container"), path = folder + "/out";
  test::spill(path, "before");
  const std::vector<float> values(1 << 18, 1.f);
  ContainerWriter writer;
  writer.add<float>("v", values, {values.size()}, "m");
  Provenance p;
  p.kind = FileKind::photons;
  {
    const SizeLimit limit(100000);
    EXPECT_NE(message([&] { writer.write(path, p); }), "");
  }
  EXPECT_EQ(test::slurp(path), "before");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(AtomicFile, WritesThroughPipes) {
  const std::string path = test::scratch("atomic-pipe") + "/pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  write_all(path, "through");
  char buffer[16] = {};
  EXPECT_EQ(::read(reader, buffer, sizeof buffer), 7);
  EXPECT_STREQ(buffer, "through");
  ::close(reader);
}

// A signal between two pieces of a container ends the work and leaves no temporary.
TEST(AtomicFileDeathTest, InterruptedContainerLeavesNothing) {
  const std::string folder = test::scratch("atomic-interrupted");
  const auto body = [&] {
    install_interrupt_handler();
    std::raise(SIGINT);
    const std::vector<float> values(10, 1.f);
    ContainerWriter writer;
    writer.add<float>("v", values, {10}, "m");
    Provenance p;
    p.kind = FileKind::photons;
    try {
      writer.write(folder + "/out", p);
    } catch (const Error& e) {
      _exit(static_cast<int>(e.code()));
    }
    _exit(0);
  };
  EXPECT_EXIT(body(), testing::ExitedWithCode(130), "");
  EXPECT_EQ(files_in(folder), 0u);
}

TEST(RequireWritable, SaysSoBeforeTheWork) {
  const std::string folder = test::scratch("writable");
  EXPECT_EQ(message([&] { require_writable(folder + "/new"); }), "");
  EXPECT_EQ(files_in(folder), 0u);
  test::spill(folder + "/file", "kept");
  EXPECT_EQ(message([&] { require_writable(folder + "/file"); }), "");
  EXPECT_EQ(test::slurp(folder + "/file"), "kept");
  EXPECT_NE(message([&] { require_writable(folder); }).find("Is a directory"), std::string::npos);
  EXPECT_NE(message([&] { require_writable(folder + "/none/out"); }).find("make the folder first"),
            std::string::npos);
  EXPECT_NE(message([&] { require_writable(folder + "/file/out"); }), "");
  EXPECT_NE(message([] { require_writable("/proc/phos-cannot-be-made"); }), "");
}

TEST(ReadText, WholeFileOrAnError) {
  const std::string folder = test::scratch("read-text");
  const std::string all(std::string("a\0b\n", 4) + std::string(100000, 'z'));
  test::spill(folder + "/a", all);
  EXPECT_EQ(read_text(folder + "/a"), all);
  EXPECT_NE(message([&] { read_text(folder + "/b"); }).find("No such file"), std::string::npos);
  EXPECT_NE(message([&] { read_text(folder); }).find("folder"), std::string::npos);
}

}  // namespace
}  // namespace phos
