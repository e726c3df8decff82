// Files written without VTK have the bytes that VTK's writers give them.

#include "Models/ModelFixtures.h"
#include "PlainArrays.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

std::string
Bytes(const std::filesystem::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

void
ExpectVtksBytes(const MedialModel & model, bool keepEdges)
{
  const TemporaryFolder folder;
  const auto            compare = [&](const char * extension, auto && writePlainly) {
    const std::filesystem::path ours = folder.Path() / (std::string("ours") + extension);
    const std::filesystem::path vtks = folder.Path() / (std::string("vtks") + extension);
    writePlainly(ours, model, keepEdges);
    WriteModel(vtks, vtks, model, { false, keepEdges });
    const std::string a = Bytes(ours);
    const std::string b = Bytes(vtks);
    ASSERT_FALSE(b.empty());
    const auto differ = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(differ.first - a.begin() - 60, 0));
    EXPECT_TRUE(a == b) << extension << ": '" << a.substr(from, 120) << "' instead of '" << b.substr(from, 120) << "'";
  };
  compare(".vtp", WritePlainVtp);
  compare(".vtk", WritePlainVtk);
}

} // namespace

TEST(PlainFiles, HaveTheBytesOfVtksWritersForCellsOfEveryKind)
{
  MedialModel model = MixedModel();
  for (const bool keepEdges : { false, true })
  {
    ExpectVtksBytes(model, keepEdges);
  }
  model.provenance = R"({"scan": "<a> & \"b\""})";
  model.inLps = false;
  model.unit = SpatialUnit::Voxels;
  model.parts[1].component = 2;
  ExpectVtksBytes(model, true);
}

TEST(PlainFiles, HaveTheBytesOfVtksWritersForTextsOfEveryLength)
{
  for (const std::size_t length : { 1, 62, 63, 64, 65, 127, 128, 16383, 16384, 20000 })
  {
    MedialModel model = MixedModel();
    model.provenance = std::string(length, 'x');
    ExpectVtksBytes(model, false);
  }
}

TEST(PlainFiles, HaveTheBytesOfVtksWritersForRefinedCoresAndTolerances)
{
  MedialModel model = MixedModel();
  model.refined = "labels";
  for (ModelPart & part : model.parts)
  {
    part.displacement.assign(part.core.cells.vertexCount, Vector3{ 0.1, -1.0 / 3, 1e-9 });
    part.radiusMargin.assign(part.core.cells.vertexCount, 1.0 / 7);
    part.core.tolerances.vertices.assign(part.core.cells.vertexCount, std::numeric_limits<double>::infinity());
    part.core.tolerances.edges.assign(part.core.cells.edges.size(), 2.0 / 3);
    part.core.tolerances.faces.assign(part.core.cells.FaceCount(), 1e300);
  }
  ExpectVtksBytes(model, true);
}

TEST(PlainFiles, HaveTheBytesOfVtksWritersForModelsWithoutCellsOrPoints)
{
  ExpectVtksBytes(MedialModel(), false);
  MedialModel points = MixedModel();
  points.parts = { points.parts[1] }; // two vertices
  ExpectVtksBytes(points, true);
}

TEST(PlainFiles, HaveTheBytesOfVtksWritersForRandomModels)
{
  const auto seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (unsigned i = 0; i < 40; ++i)
  {
    ExpectVtksBytes(RandomModel(seed + i, 1 + static_cast<int>(i % 6), 1 + static_cast<int>(i % 3)), i % 2 == 0);
  }
}
