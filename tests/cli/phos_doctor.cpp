// phos doctor on machines that lack something.
#include <gtest/gtest.h>

#include "core/json.h"
#include "file/json_parse.h"
#include "support/script.h"

namespace phos {
namespace {

using test::Run;

Run run_doctor(std::vector<std::string> settings, const std::vector<std::string>& arguments = {"--json"},
               const std::string& phos = std::string(PHOS_TOOLS) + "/phos") {
  settings.insert(settings.begin(), "/usr/bin/env");
  settings.insert(settings.end(), {phos, "doctor"});
  settings.insert(settings.end(), arguments.begin(), arguments.end());
  return test::run_shell(settings, test::scratch("doctor"));
}

struct Row {
  bool ok = false, required = false;
  std::string found, remedy;
};

Row row_of(const Run& run, const std::string& name) {
  const Json all = parse_json(run.out, "doctor");
  for (const Json& row : all.find("checks")->as_array())
    if (row.find("name")->as_string() == name)
      return {row.find("ok")->as_bool(), row.find("required")->as_bool(), row.find("found")->as_string(),
              row.find("remedy")->as_string()};
  ADD_FAILURE() << "no check of " << name << ": " << run.out;
  return {};
}

/// A folder whose one program is a link to another.
std::string path_with(const std::string& name, const std::string& program) {
  const std::string folder = test::scratch("doctor-" + name);
  std::filesystem::create_symlink(program, folder + "/" + name);
  return folder;
}

bool ready(const Run& run) { return parse_json(run.out, "doctor").find("ready")->as_bool(); }

TEST(Doctor, AllIsWellHere) {
  const auto run = run_doctor({"LC_ALL=C.UTF-8"});
  EXPECT_EQ(run.err, "");
  ASSERT_TRUE(row_of(run, "programs").ok) << run.out;
  ASSERT_TRUE(row_of(run, "OSMesa").ok) << run.out;
  EXPECT_NE(row_of(run, "OSMesa").found.find("OpenGL 4.5"), std::string::npos) << run.out;
  EXPECT_TRUE(row_of(run, "locale").ok) << run.out;
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(ready(run));
  const auto text = run_doctor({}, {});
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(text.out.find("ok       programs"), 0u) << text.out;
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 12);
}

TEST(Doctor, WithoutHelpers) {
  const auto run = run_doctor({"PATH=/nowhere"});
  EXPECT_EQ(run.code, 0) << run.out;
  for (const auto& [name, package] :
       {std::pair{"ffmpeg", "ffmpeg"}, {"jq", "jq"}, {"awk", "mawk"}, {"man", "man-db"}}) {
    const Row row = row_of(run, name);
    EXPECT_FALSE(row.ok || row.required) << name;
    EXPECT_EQ(row.remedy, std::string("apt-get install ") + package);
  }
  const auto text = run_doctor({"PATH=/nowhere"}, {});
  EXPECT_NE(text.out.find("missing  ffmpeg"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("not required: apt-get install ffmpeg\n"), std::string::npos) << text.out;
}

TEST(Doctor, AHelperThatDoesNotWork) {
  const Row row = row_of(run_doctor({"PATH=" + path_with("ffmpeg", "/bin/echo")}), "ffmpeg");
  EXPECT_FALSE(row.ok);
  EXPECT_NE(row.found.find("answers \"-version\""), std::string::npos) << row.found;
}

TEST(Doctor, TemporaryFolderThatIsNotThereOrCannotBeWritten) {
  const std::string file = test::scratch("doctor-file") + "/file";
  test::spill(file, "");
  for (const std::string& folder : {std::string("/nowhere/at/all"), file, std::string("/proc")}) {
    const auto run = run_doctor({"TMPDIR=" + folder});
    EXPECT_EQ(run.code, 1) << folder;
    EXPECT_FALSE(ready(run));
    const Row row = row_of(run, "temporary folder");
    EXPECT_TRUE(!row.ok && row.required) << folder;
    EXPECT_EQ(row.found.find(folder + ": "), 0u) << row.found;
  }
}

TEST(Doctor, OpenGLThatIsBroken) {
  const std::string folder = test::scratch("doctor-gl");
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
    test::spill(folder + "/" + name, "no library");
  for (const std::string& setting :
       {"LD_LIBRARY_PATH=" + folder, std::string("LP_NATIVE_VECTOR_WIDTH=128")}) {
    const auto run = run_doctor({setting});
    EXPECT_EQ(run.code, 1) << run.out;
    const Row row = row_of(run, "OSMesa");
    EXPECT_TRUE(!row.ok && row.required) << setting;
    EXPECT_NE(row.remedy.find("apt-get install libosmesa6"), std::string::npos) << row.remedy;
  }
}

TEST(Doctor, EglIsThereOrNot) {
  const Row here = row_of(run_doctor({}), "EGL");
  EXPECT_FALSE(here.required);
  if (here.ok) {
    EXPECT_NE(here.found.find(", EGL 1."), std::string::npos) << here.found;
    EXPECT_TRUE(here.found.ends_with("; draws")) << here.found;
  }
  const auto run = run_doctor({"__EGL_VENDOR_LIBRARY_DIRS=/nowhere"});
  EXPECT_EQ(run.code, 0) << run.out;
  EXPECT_TRUE(ready(run));
  const Row row = row_of(run, "EGL");
  EXPECT_FALSE(row.ok || row.required);
  EXPECT_NE(row.found.find("no OpenGL 4.5 core context from EGL: "), std::string::npos) << row.found;
  EXPECT_NE(row.remedy.find("apt-get install libegl1"), std::string::npos) << row.remedy;
}

TEST(Doctor, ProgramsThatAreMissingOrOfAnotherVersion) {
  const std::string folder = test::scratch("doctor-alone");
  std::filesystem::copy_file(std::string(PHOS_TOOLS) + "/phos", folder + "/phos");
  test::spill(folder + "/phos-info", "#!/bin/sh\necho phos-info 0.0.0\n");
  std::filesystem::permissions(folder + "/phos-info", std::filesystem::perms::owner_all);
  const auto run = run_doctor({"PATH=/nowhere"}, {"--json"}, folder + "/phos");
  EXPECT_EQ(run.code, 1);
  const Row row = row_of(run, "programs");
  EXPECT_FALSE(row.ok);
  EXPECT_NE(row.found.find("phos-splat is neither beside phos nor on PATH"), std::string::npos) << row.found;
  EXPECT_NE(row.found.find("is \"phos-info 0.0.0\", not \""), std::string::npos) << row.found;
}

TEST(Doctor, LocaleThatIsNotInstalled) {
  const auto run = run_doctor({"LC_ALL=xx_XX.UTF-8"});
  EXPECT_EQ(run.code, 0);
  const Row row = row_of(run, "locale");
  EXPECT_FALSE(row.ok || row.required);
  EXPECT_NE(row.found.find("LC_ALL=xx_XX.UTF-8"), std::string::npos) << row.found;
}

TEST(Doctor, CommandLine) {
  const auto wrong = run_doctor({}, {"--jason"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(test::is_one_line(wrong.err)) << wrong.err;
  EXPECT_NE(wrong.err.find("did you mean \"--json\"?"), std::string::npos) << wrong.err;
  EXPECT_EQ(run_doctor({}, {"all"}).code, 2);
}

}  // namespace
}  // namespace phos
