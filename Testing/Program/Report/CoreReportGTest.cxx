#include "voxelcore/Base/Error.h"
#include "voxelcore/Report/CoreReport.h"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace voxelcore
{
namespace
{

using Json = nlohmann::ordered_json;

ComplexRecord
MakeComplex(std::uint64_t faces, double area)
{
  ComplexRecord complex;
  complex.vertices = faces + 2;
  complex.edges = 2 * faces + 1;
  complex.faces = faces;
  complex.topology = { 1, { 1, 0, 0 } };
  complex.areaMm2 = area;
  complex.maxRadiusMm = 2.5;
  return complex;
}

/** Two labels, two lambdas, awkward numbers. */
CoreReport
MakeReport()
{
  CoreReport report;
  report.command = "voxelcore core a.nii.gz -o x.vtp";
  report.input = { "/data/a.nii.gz", std::string(64, 'a'), "NIfTI-1", {}, { "a note" } };
  report.input.geometry.size = { 3, 4, 5 };
  report.input.geometry.spacing = { 0.1, 1.0 / 3, 2 };
  report.input.geometry.origin = { -1e-17, 12345.678901234567, 0 };
  report.parameters.labels = { 1, 7 };
  report.parameters.lambda = { "0", "1.5vox" };
  report.parameters.reading.threshold = { { -100.5, 3000 } };
  report.parameters.engine = "tetgen";
  report.parameters.threads = 2;
  report.parameters.weights.weight = { 3, 10, 60 };
  for (const std::int64_t value : { 1, 7 })
  {
    LabelRecord label;
    label.label = value;
    label.name = "N" + std::to_string(value);
    label.voxels = 60;
    label.volumeMm3 = 0.1 + 0.2;
    label.box = { { 1, 2, 3 }, { 4, 5, 6 } };
    label.boundaryVertices = 120;
    label.shape = { 1, { 1, 0, 0 } };
    label.core = MakeComplex(9, 1.0 / 7);
    label.pruned = { { { "0", 0, MakeComplex(9, 1.0 / 7), {}, {} }, "x_lambda-0.vtp" },
                     { { "1.5vox", 0.15, MakeComplex(4, 1.0 / 9), {}, {} }, "x_lambda-1.5vox.vtp" } };
    label.topologyEqual = true;
    label.enclosed = true;
    label.seconds = 0.5;
    report.labels.push_back(label);
  }
  report.seconds.total = 1.23456;
  report.peakMemoryMb = 123.456;
  return report;
}

std::vector<std::string>
Keys(const Json & json)
{
  std::vector<std::string> keys;
  for (const auto & [key, value] : json.items())
  {
    keys.push_back(key);
  }
  return keys;
}

using Texts = std::vector<std::string>;

TEST(CoreReport, HasTheDocumentedKeysInTheirOrder)
{
  const Json json = Json::parse(ReportJson(MakeReport()));
  EXPECT_EQ(Keys(json), (Texts{ "voxelcore", "input", "parameters", "labels", "seconds", "peak_memory_mb" }));
  EXPECT_EQ(Keys(json["voxelcore"]), (Texts{ "version", "command" }));
  EXPECT_EQ(Keys(json["input"]),
            (Texts{ "path", "sha256", "format", "size", "spacing_mm", "origin_mm", "direction", "notes" }));
  const Json & label = json["labels"][1];
  EXPECT_EQ(Keys(label),
            (Texts{ "label",
                    "name",
                    "voxels",
                    "volume_mm3",
                    "bounding_box",
                    "boundary_vertices",
                    "shape",
                    "core",
                    "pruned",
                    "certificate" }));
  EXPECT_EQ(Keys(label["shape"]), (Texts{ "euler", "betti" }));
  EXPECT_EQ(Keys(label["core"]),
            (Texts{ "vertices", "edges", "faces", "euler", "betti", "area_mm2", "max_radius_mm" }));
  EXPECT_EQ(Keys(label["pruned"][1]),
            (Texts{ "lambda",
                    "lambda_mm",
                    "vertices",
                    "edges",
                    "faces",
                    "euler",
                    "betti",
                    "area_mm2",
                    "max_radius_mm",
                    "output" }));
  EXPECT_EQ(Keys(label["certificate"]), (Texts{ "topology", "enclosed", "passed" }));
  EXPECT_EQ(Keys(json["seconds"]), (Texts{ "read", "shape", "delaunay", "core", "prune", "write", "total" }));
  EXPECT_EQ(json["parameters"]["lattice_weights"], (Json{ 3, 10, 60 }));
  EXPECT_EQ(json["parameters"]["engine"], "tetgen");
  EXPECT_EQ(json["labels"].size(), 2U);
  EXPECT_EQ(json["labels"][0]["pruned"].size(), 2U);
}

TEST(CoreReport, ProvenanceLeavesOutWhatChangesFromRunToRun)
{
  CoreReport        one = MakeReport();
  CoreReport        two = MakeReport();
  const std::string text = ProvenanceJson(one, { 0, 1 }, 1);
  two.command = "another";
  two.input.path = "elsewhere.nii.gz";
  two.parameters.engine = "other";
  two.parameters.threads = 64;
  two.labels[0].pruned[1].output = "y.vtp";
  two.labels[0].seconds = 99;
  two.seconds.total = 99;
  two.peakMemoryMb = 99;
  EXPECT_EQ(ProvenanceJson(two, { 0, 1 }, 1), text);
  two.labels[0].voxels += 1;
  EXPECT_NE(ProvenanceJson(two, { 0, 1 }, 1), text);
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(CoreReport, ProvenanceNamesOnlyWhatIsInTheFile)
{
  const Json json = Json::parse(ProvenanceJson(MakeReport(), { 1 }, 0));
  ASSERT_EQ(json["labels"].size(), 1U);
  EXPECT_EQ(json["labels"][0]["label"], 7);
  ASSERT_EQ(json["labels"][0]["pruned"].size(), 1U);
  EXPECT_EQ(json["labels"][0]["pruned"][0]["lambda"], "0");
  EXPECT_EQ(json["parameters"]["lambda"], Json{ "0" });
  EXPECT_EQ(json["parameters"]["labels"], Json{ 7 });
}

TEST(CoreReport, ProvenanceSurvivesReadingToTheLastBit)
{
  const std::string text = ProvenanceJson(MakeReport(), { 0, 1 }, 1);
  const CoreReport  read = ParseProvenance(text, "a.vtp");
  EXPECT_EQ(ProvenanceJson(read, { 0, 1 }, 0), text);
  EXPECT_EQ(read.labels[1].volumeMm3, 0.1 + 0.2);
  EXPECT_EQ(read.input.geometry.spacing[1], 1.0 / 3);
  ASSERT_TRUE(read.parameters.reading.threshold.has_value());
  EXPECT_EQ(read.parameters.reading.threshold->first, -100.5);
  EXPECT_FALSE(read.parameters.reading.spacing.has_value());
}

TEST(CoreReport, EditsAndInfiniteThresholdsSurviveReading)
{
  CoreReport report = MakeReport();
  report.parameters.reading.threshold = { { -std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::infinity() } };
  report.parameters.reading.crop = CropRange{ { 0, 1, 2 }, { 10, 11, 12 } };
  report.parameters.reading.component = 2;
  report.parameters.edits = { MedianWidth{ 5 },
                              true,
                              true,
                              ParseGapWidth("4vox"),
                              ParseGapWidth("2.5mm"),
                              true,
                              SliceAxis::J,
                              Connectivity::TwentySix,
                              true,
                              false,
                              1.25,
                              50,
                              3,
                              true,
                              ParseGapWidth("2vox"),
                              TopologyRequest{ 1, 0, {} },
                              true,
                              ParseVoxelChanges("+1,2,3 -4,5,6x7") };
  EditRecord::Simplified simplified{ { 2, { 3, 2, 1 } }, { 1, { 1, 1, 1 } }, false, "too deep", 31, 32, 33, 34, {} };
  simplified.changes.push_back({ true, { 1, 2, 3.5 }, 35, 36.25, { -1, 0, 1 } });
  for (LabelRecord & label : report.labels)
  {
    label.label = 7;
    label.component = &label - report.labels.data() + 1;
    label.edits = EditRecord{ 2,
                              3,
                              4,
                              5,
                              6,
                              EditRecord::Filtered{ 29, 30 },
                              EditRecord::Filtered{ 39, 40 },
                              EditRecord::Mended{ 7, 8, 9, 10, 11 },
                              EditRecord::Filled{ 21, 22, 0 },
                              EditRecord::Filled{ 23, 24, 25 },
                              EditRecord::Filled{ 26, 27, 28 },
                              EditRecord::Connected{ { 2, { 3, 2, 1 } }, 43, 44, 45, {} },
                              EditRecord::Touching{ 46, 47, 48, {} },
                              EditRecord::Filled{ 41, 0, 42 },
                              EditRecord::Smoothed{ 12, 13, 1 },
                              simplified,
                              EditRecord::Filtered{ 37, 38 } };
  }
  const std::string text = ProvenanceJson(report, { 0, 1 }, 1);
  const CoreReport  read = ParseProvenance(text, "a.vtp");
  EXPECT_EQ(ProvenanceJson(read, { 0, 1 }, 0), text);
  EXPECT_EQ(read.parameters.reading.threshold, report.parameters.reading.threshold);
  EXPECT_EQ(read.parameters.labels, (std::vector<std::int64_t>{ 7 })) << "a label of two components is one label";
  EXPECT_EQ(read.labels[1].component, 2);
  ASSERT_TRUE(read.parameters.reading.crop && read.labels[1].edits);
  EXPECT_EQ(read.parameters.reading.crop, report.parameters.reading.crop);
  EXPECT_EQ(read.parameters.reading.component, 2);
  EXPECT_EQ(read.labels[1].edits->componentsRemoved, 5U);
  const Json json = Json::parse(text);
  EXPECT_EQ(json["parameters"]["crop"], (Json{ { 0, 10 }, { 1, 11 }, { 2, 12 } }));
  EXPECT_EQ(json["parameters"]["change_voxels"], (Json{ "+1,2,3", "-4,5,6x7" })) << "no list in a string";
  std::string       former = text;
  const std::string list = R"("change_voxels":["+1,2,3","-4,5,6x7"])";
  ASSERT_NE(former.find(list), std::string::npos);
  former.replace(former.find(list), list.size(), R"("change_voxels":"+1,2,3 -4,5,6x7")");
  EXPECT_EQ(ParseProvenance(former, "a.vtp").parameters.edits.change, report.parameters.edits.change);
  EXPECT_EQ(read.parameters.edits.change, report.parameters.edits.change);
  EXPECT_EQ(json["labels"][0]["edits"]["changed"]["voxels_removed"], 38);
  EXPECT_EQ(json["labels"][0]["edits"]["voxels_added"], 3);
  EXPECT_EQ(json["labels"][0]["edits"]["mended"]["pieces_joined"], 9);
  EXPECT_EQ(json["labels"][0]["edits"]["smoothed"]["voxels_removed"], 13);
  EXPECT_EQ(json["labels"][0]["edits"]["connected"]["pieces_joined"], 43);
  EXPECT_EQ(json["labels"][0]["edits"]["closed"]["components_joined"], 22);
  EXPECT_EQ(read.labels[1].edits->slices->holes, 28U);
  const auto & found = *read.labels[1].edits->simplified;
  EXPECT_EQ(found.before, simplified.before);
  EXPECT_EQ(found.after, simplified.after);
  EXPECT_EQ(found.asAsked, false);
  EXPECT_EQ(found.reason, "too deep");
  EXPECT_EQ(found.voxelsRemoved, 34U);
  EXPECT_EQ(read.parameters.edits.topology.loops, 0);
  EXPECT_FALSE(json["labels"][0]["edits"]["topology_simplified"].contains("changes")) << "files hold no long list";
  const Json change = Json::parse(ReportJson(report))["labels"][0]["edits"]["topology_simplified"]["changes"].at(0);
  EXPECT_EQ(change,
            (Json{ { "kind", "fill" },
                   { "centre_mm", { 1, 2, 3.5 } },
                   { "voxels", 35 },
                   { "cost_voxels", 36.25 },
                   { "pieces", -1 },
                   { "loops", 0 },
                   { "cavities", 1 } }));
  // The second component by itself, as in a file of its own.
  EXPECT_EQ(Json::parse(ProvenanceJson(report, { 1 }, 1))["parameters"]["labels"], Json{ 7 });
}

TEST(CoreReport, DamagedProvenanceIsRefused)
{
  for (const char * text : { "", "no json", "{}", "[]", "{\"input\":{}}" })
  {
    EXPECT_THROW(ParseProvenance(text, "a.vtp"), InputError) << text;
  }
  std::string missing = ProvenanceJson(MakeReport(), { 0 }, 0);
  missing.replace(missing.find("\"euler\""), 7, "\"euled\"");
  EXPECT_THROW(ParseProvenance(missing, "a.vtp"), InputError);
}

TEST(CoreReport, ProvenanceOfMoreMembersThanCanBeSearchedIsRefused)
{
  std::string text = ProvenanceJson(MakeReport(), { 0 }, 0);
  for (int i = 0; i < 5000; ++i)
  {
    text.insert(text.rfind('}'), ",\"k" + std::to_string(i) + "\":0");
  }
  EXPECT_THROW(ParseProvenance(text, "a.vtp"), InputError);
}

TEST(CoreReport, NamesThatAreNoUtf8DoNotBreakIt)
{
  CoreReport report = MakeReport();
  report.labels[0].name = "h\xE4lfte \"x\"";
  EXPECT_NO_THROW(Json::parse(ReportJson(report)));
  EXPECT_NO_THROW(ParseProvenance(ProvenanceJson(report, { 0 }, 0), "a.vtp"));
}

TEST(CoreReport, DescribesAreaAndRadius)
{
  // A unit square, and a triangle of area 2 standing on one of its sides.
  MedialComplex complex;
  complex.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0, 4 } };
  complex.radius = { 1, 2, 3, 2, 1 };
  complex.cells.vertexCount = 5;
  complex.cells.faceOffsets = { 0, 4, 7 };
  complex.cells.faceVertices = { 0, 1, 2, 3, 0, 1, 4 };
  complex.cells.edges = { { 0, 1 }, { 0, 3 }, { 0, 4 }, { 1, 2 }, { 1, 4 }, { 2, 3 } };
  complex.cells.faceEdges = { 0, 3, 5, 1, 0, 4, 2 };
  const ComplexRecord record = DescribeComplex(complex, { 1, { 1, 0, 0 } });
  EXPECT_DOUBLE_EQ(record.areaMm2, 3);
  EXPECT_EQ(record.maxRadiusMm, 3);
  EXPECT_EQ(record.faces, 2U);
}

} // namespace
} // namespace voxelcore
