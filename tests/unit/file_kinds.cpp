// The tables of file kinds, and what reads them.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "core/error.h"
#include "file/kinds/page.h"
#include "file/kinds/shape_pattern.h"
#include "file/kinds/tables.h"
#include "file/kinds/tensor_io.h"
#include "support/complaint.h"
#include "support/run.h"

namespace phos {
namespace {

TEST(FileKinds, ThePageHoldsTheTables) {
  const std::string page = test::slurp(std::string(PHOS_SOURCE) + "/docs/reference/files.md");
  const std::string begin = "<!-- kinds: made from lib/file/kinds/tables.cpp -->\n\n",
                    end = "\n<!-- /kinds -->\n";
  const std::size_t from = page.find(begin), to = page.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()), kind_sections())
      << "docs/reference/files.md should hold between those lines:\n\n"
      << kind_sections();
  for (const KindRow& kind : all_kinds())
    EXPECT_NE(page.find('\n' + kind_line(kind)), std::string::npos)
        << "it lacks the line " << kind_line(kind);
}

TEST(FileKinds, HaveNamesAndRowsOfTheirOwn) {
  for (const KindRow& kind : all_kinds()) {
    EXPECT_EQ(&row_of(kind.kind), &kind) << "in order of FileKind";
    EXPECT_EQ(kind_named(name_of(kind.kind)), kind.kind);
    std::set<std::string_view> names;
    for (const TensorGroup& group : kind.groups) {
      EXPECT_FALSE(group.rows.empty());
      for (const TensorRow& row : group.rows) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name << " has two rows";
        EXPECT_EQ(find_row(kind.kind, tensor_name(row, "12")), &row);
        EXPECT_FALSE(row.unit.empty()) << row.name;
        EXPECT_FALSE(row.meaning.empty()) << row.name;
        EXPECT_EQ(row.meaning.find('|'), std::string::npos) << row.name;
        EXPECT_EQ(row.check.words.empty(), row.check.rule == NumberCheck::Rule::any) << row.name;
        EXPECT_TRUE(
            std::regex_match(std::string(row.shape),
                             std::regex(R"((([0-9]+|rgb|xyz|(K\.)?[A-Za-z_]+(\+1|\^2)?)(,(?!$)|$))+)")))
            << row.name << ' ' << row.shape;
      }
    }
  }
  EXPECT_FALSE(kind_named("view"));
  EXPECT_EQ(find_row(FileKind::brdf, "orders"), nullptr);
  EXPECT_EQ(find_row(FileKind::brdf, "x.orders"), nullptr);
  EXPECT_EQ(find_row(FileKind::brdf, "K.orders"), nullptr);
  EXPECT_EQ(find_row(FileKind::photons, "irradiance"), nullptr);
}

TEST(FileKinds, FormsAreThoseOfTheHeader) {
  EXPECT_EQ(form_of(Json()), FileForm::whole);
  for (const FileForm form : {FileForm::shard, FileForm::part, FileForm::film}) {
    Json extra = Json::Object{{"accuracy", 0.2}};
    EXPECT_EQ(form_of(extra), FileForm::whole);
    extra[name_of(form)] = "1/2";
    EXPECT_EQ(form_of(extra), form);
  }
}

TEST(ShapePattern, SymbolsAreTheSameNumberInAFile) {
  const auto row = [](std::string_view shape) {
    return TensorRow{"x", Dtype::f32, shape, "1", {NumberCheck::Rule::any, ""}, "x"};
  };
  Extents known;
  EXPECT_TRUE(fits(row("n,rgb,N^2"), "", {7, 3, 16}, known));
  EXPECT_EQ(known, (Extents{{"n", 7}, {"N", 4}}));
  EXPECT_TRUE(fits(row("n,N"), "", {7, 4}, known));
  EXPECT_FALSE(fits(row("n,N"), "", {7, 5}, known));
  EXPECT_FALSE(fits(row("n,N"), "", {7}, known));
  EXPECT_FALSE(fits(row("n,N"), "", {7, 4, 1}, known));
  EXPECT_FALSE(fits(row("n,xyz"), "", {7, 4}, known));
  EXPECT_FALSE(fits(row("M^2"), "", {15}, known));
  EXPECT_TRUE(fits(row("cells+1,2"), "", {6, 2}, known));
  EXPECT_EQ(known.at("cells"), 5u);
  EXPECT_FALSE(fits(row("other+1"), "", {0}, known));
  EXPECT_TRUE(fits(row("K.rows"), "3", {9}, known));
  EXPECT_TRUE(fits(row("K.rows"), "4", {2}, known));
  EXPECT_EQ(known.at("3.rows"), 9u);
  EXPECT_EQ(shape_of(row("n,rgb,N^2"), "", 336, known), (Shape{7, 3, 16}));
  EXPECT_EQ(shape_of(row("new,rgb"), "", 12, known), (Shape{4, 3}));
  EXPECT_EQ(index_name(row("n,rgb,xyz"), 1, 1), "g");
  EXPECT_EQ(index_name(row("n,rgb,xyz"), 2, 1), "y");
  EXPECT_EQ(index_name(row("n,rgb,N"), 2, 1), "1");
}

TEST(TensorWriter, AbortsForWhatTheTableLacks) {
  const std::vector<float> v(6);
  EXPECT_DEATH(TensorWriter(FileKind::photons).add<float>("colour", v), "has no row");
  EXPECT_DEATH(TensorWriter(FileKind::photons).add<float>("path", v), "not U8");
  EXPECT_DEATH(
      {
        TensorWriter writer(FileKind::photons);
        writer.add<float>("distance", v);
        writer.add<float>("flux", v);
      },
      "flux");
}

TEST(TensorWriter, TakesShapeAndUnitFromTheTable) {
  const std::string path = test::scratch("file_kinds") + "/a";
  const std::vector<float> light(2 * 3 * 4), error(2 * 3 * 2);
  TensorWriter writer(FileKind::radiance);
  writer.extent("N", 2);
  writer.add<float>("coefficients", light);
  writer.add<float>("stderr", error);
  writer.write(path, Provenance());
  const Container file = Container::open(path, FileKind::radiance);
  EXPECT_EQ(file.tensors().at("coefficients").shape, (Shape{2, 3, 4}));
  EXPECT_EQ(file.tensors().at("stderr").shape, (Shape{2, 3, 2}));
  EXPECT_EQ(file.tensors().at("stderr").unit, "cd/m2 sqrt(sr)");
  EXPECT_NE(test::complaint_of([&] { TensorReader reader(file); }).find("has no tensor \"position\""),
            std::string::npos);
}

}  // namespace
}  // namespace phos
