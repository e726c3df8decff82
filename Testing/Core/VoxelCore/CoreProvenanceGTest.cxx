#include "voxelcore/VoxelCore/CoreProvenance.h"

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Complex/ComplexTopology.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::ordered_json;

ComplexRecord
Record(const TopologyNumbers & topology)
{
  return { 10, 20, 11, topology, 4.5, 1.25 };
}

/** Two labels of a scan. */
std::vector<CoreOrigin>
Origins()
{
  const TopologyNumbers ring{ 0, { 1, 1, 0 } };
  return { { 3, "left \"lung\"", 120, { { 1, 2, 3 }, { 4, 5, 6 } }, 77, ring, Record(ring), true },
           { 9, "broken", 5, {}, 8, ring, Record({ 1, { 1, 0, 0 } }), true } };
}

std::string
ProvenanceOf(const std::string & lambda, double lambdaMm)
{
  ImageGeometry geometry;
  geometry.size = { 30, 20, 10 };
  geometry.spacing = { 0.5, 0.5, 2 };
  return CoreProvenanceJson(geometry,
                            Origins(),
                            { { lambda, lambdaMm, Record({}) }, { lambda, lambdaMm, Record({}) } },
                            false);
}

TEST(CoreProvenance, AComplexIsDescribedByItsCountsItsAreaAndItsLargestRadius)
{
  // A plate of 4 x 5 voxels in one layer: a grid of 3 x 4 squares.
  const MedialComplex core = CoreOf(Box({ 4, 5, 1 }));
  const ComplexRecord record = DescribeComplex(core, ComputeComplexTopology(core.cells));
  EXPECT_EQ(record.vertices, 20U);
  EXPECT_EQ(record.edges, 31U);
  EXPECT_EQ(record.faces, 12U);
  EXPECT_EQ(record.areaMm2, 12);
  EXPECT_EQ(record.topology, (TopologyNumbers{ 1, { 1, 0, 0 } }));
  EXPECT_DOUBLE_EQ(record.maxRadiusMm, std::sqrt(0.75));
  EXPECT_EQ(DescribeComplex({}, {}).maxRadiusMm, 0);
}

TEST(CoreProvenance, HoldsWhatPruningAndVerifyingNeed)
{
  const Json json = Json::parse(ProvenanceOf("2vox", 1));
  EXPECT_EQ(json.at("input").at("spacing_mm"), (Json{ 0.5, 0.5, 2 }));
  EXPECT_EQ(json.at("parameters").at("lattice_weights"), (Json{ 1, 1, 4 }));
  EXPECT_EQ(json.at("parameters").at("lambda"), Json{ "2vox" });
  const Json & label = json.at("labels").at(0);
  EXPECT_EQ(label.at("name"), "left \"lung\"");
  EXPECT_EQ(label.at("volume_mm3"), 60);
  EXPECT_EQ(label.at("bounding_box").at("size"), (Json{ 4, 5, 6 }));
  EXPECT_EQ(label.at("pruned").at(0).at("lambda_mm"), 1);
  EXPECT_TRUE(label.at("certificate").at("passed").get<bool>());
}

TEST(CoreProvenance, ACertificateThatDoesNotHoldIsNotSaidToHold)
{
  const Json json = Json::parse(ProvenanceOf("0", 0));
  EXPECT_FALSE(json.at("labels").at(1).at("certificate").at("topology").get<bool>());
  EXPECT_FALSE(json.at("labels").at(1).at("certificate").at("passed").get<bool>());
}

TEST(CoreProvenance, PruningFurtherReplacesTheLambdaAndPruningLessDoesNot)
{
  const std::string before = ProvenanceOf("2vox", 1);
  const auto        lambdaAfter = [&](const std::string & lambda, double lambdaMm) {
    const CorePruning pruning{ lambda, lambdaMm, Record({ 1, { 1, 0, 0 } }) };
    const Json        json = Json::parse(PrunedProvenanceJson(before, { pruning, pruning }));
    EXPECT_EQ(json.at("labels").at(1).at("pruned").size(), 1U);
    EXPECT_EQ(json.at("labels").at(1).at("pruned").at(0).at("euler"), 1);
    EXPECT_EQ(json.at("labels").at(1).at("core"), Json::parse(before).at("labels").at(1).at("core"));
    EXPECT_EQ(json.at("parameters").at("lambda").at(0), json.at("labels").at(0).at("pruned").at(0).at("lambda"));
    return json.at("labels").at(0).at("pruned").at(0).at("lambda").get<std::string>();
  };
  EXPECT_EQ(lambdaAfter("3vox", 1.5), "3vox");
  EXPECT_EQ(lambdaAfter("1vox", 0.5), "2vox");
}

TEST(CoreProvenance, SaysWhereBodiesLie)
{
  const std::vector<BodyPlace> places = RecordedPlaces(ProvenanceOf("2vox", 1));
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places[0].geometry.spacing, (Vector3{ 0.5, 0.5, 2 }));
  EXPECT_EQ(places[0].box.size, (std::array<std::int32_t, 3>{ 4, 5, 6 }));
  EXPECT_TRUE(RecordedPlaces("{}").empty());
  EXPECT_TRUE(RecordedPlaces("no JSON").empty());
}

TEST(CoreProvenance, WhatIsNoRecordOfTheseLabelsGivesNone)
{
  const CorePruning pruning{ "3vox", 1.5, Record({}) };
  EXPECT_EQ(PrunedProvenanceJson("{}", { pruning }), "");
  EXPECT_EQ(PrunedProvenanceJson("no JSON", { pruning }), "");
  EXPECT_EQ(PrunedProvenanceJson(ProvenanceOf("0", 0), { pruning }), "") << "of two labels";
  EXPECT_EQ(PrunedProvenanceJson(ProvenanceOf("0", 0), {}), "");
  Json pruned = Json::parse(ProvenanceOf("0", 0));
  pruned["labels"][0]["pruned"][0]["tolerance"] = "1diag";
  EXPECT_EQ(PrunedProvenanceJson(pruned.dump(), { pruning, pruning }), "") << "lambda no longer says what is left";
  std::string deep = ProvenanceOf("0", 0);
  deep.insert(deep.rfind('}'), ",\"x\":" + std::string(200000, '[') + std::string(200000, ']'));
  EXPECT_EQ(PrunedProvenanceJson(deep, { pruning, pruning }), "") << "written by recursion, it would end the stack";
}

} // namespace
} // namespace voxelcore::testing
