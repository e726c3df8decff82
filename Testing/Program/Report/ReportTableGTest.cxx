#include "voxelcore/Report/ReportTable.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

TEST(ReportTable, ColumnsAreAlignedAlsoWithLettersOfSeveralBytes)
{
  EXPECT_EQ(FormatTable({ { "n", "name", "v" }, { "10", "Hälfte", "7" }, { "1", "x", "1234" } }),
            " n  name       v\n"
            "10  Hälfte     7\n"
            " 1  x       1234\n");
}

TEST(ReportTable, HasARowPerLabelAndAColumnPerLambda)
{
  CoreReport report;
  report.parameters.lambda = { "0", "2mm" };
  LabelRecord label;
  label.label = 7;
  label.name = "Liver";
  label.voxels = 11;
  label.boundaryVertices = 22;
  label.shape = { -1, { 1, 2, 0 } };
  label.core.faces = 33;
  label.core.topology = { -1, { 1, 2, 0 } };
  label.pruned.resize(2);
  label.pruned[0].complex.faces = 33;
  label.pruned[1].complex.faces = 5;
  label.topologyEqual = label.enclosed = true;
  label.seconds = 1.234;
  report.labels = { label };
  report.seconds.total = 2;
  report.peakMemoryMb = 3;
  EXPECT_EQ(ReportTable(report),
            "label  name   voxels  boundary vertices  core faces  faces at 0  faces at 2mm  shape chi/b0/b1/b2  core "
            "chi/b0/b1/b2  certificate  seconds\n"
            "    7  Liver      11                 22          33          33             5            -1/1/2/0       "
            "    -1/1/2/0       passed     1.23\n"
            "1 label, 22 boundary vertices, 2.00 s, peak memory 3 MB\n");
  report.labels[0].enclosed = false;
  EXPECT_NE(ReportTable(report).find("FAILED"), std::string::npos);
}

TEST(ReportTable, ACsvNamesWhatItsPartsWerePrunedBy)
{
  CoreReport  report;
  LabelRecord label;
  label.pruned.resize(1);
  label.pruned[0].lambda = "2mm";
  report.labels = { label };
  EXPECT_TRUE(LabelTableCsv(report).starts_with("label,name,component,lambda,voxels,"));
  report.parameters.tolerances = { "1.2diag" };
  report.labels[0].pruned[0].tolerance = ToleranceNumbers{};
  report.labels[0].pruned[0].tolerance->height = "1.2diag";
  const std::string csv = LabelTableCsv(report);
  EXPECT_TRUE(csv.starts_with("label,name,component,tolerance,voxels,"));
  EXPECT_NE(csv.find(",1.2diag,"), std::string::npos);
}

TEST(ReportTable, NanometresAreNoZeros)
{
  CoreReport report;
  report.parameters.tolerances = { "1.2diag" };
  LabelRecord label;
  label.pruned.resize(1);
  label.pruned[0].tolerance = ToleranceNumbers{};
  label.pruned[0].tolerance->boundaryGapMm = 48.07e-6;
  label.skeleton = SkeletonRecord{};
  label.skeleton->numbers.totalLength = 0.32e-3;
  label.skeleton->numbers.meanRadius = 32.1e-6;
  report.labels = { label };
  EXPECT_NE(ReportTable(report).find("gap nm"), std::string::npos);
  EXPECT_NE(ReportTable(report).find("48.070"), std::string::npos);
  const std::string table = SkeletonTable(report);
  EXPECT_NE(table.find("length um"), std::string::npos);
  EXPECT_NE(table.find("mean radius um"), std::string::npos);
  EXPECT_NE(table.find(" 0.32 "), std::string::npos);
  EXPECT_NE(table.find(" 0.032 "), std::string::npos);
  report.labels[0].skeleton->numbers.totalLength = 123.456;
  report.labels[0].skeleton->numbers.meanRadius = 1.5;
  EXPECT_NE(SkeletonTable(report).find("  length mm"), std::string::npos);
  EXPECT_NE(SkeletonTable(report).find("123.46            1.50"), std::string::npos);
}

} // namespace
} // namespace voxelcore
