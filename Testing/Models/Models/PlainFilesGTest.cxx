// Files have the bytes that VTK's writers give them; those of .vtp once they are unpacked.

#include "Models/Models/ModelFixtures.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <gtest/gtest.h>

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <omp.h>

#include <filesystem>
#include <limits>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

void
ExpectSame(const std::string & ours, const std::string & vtks)
{
  ASSERT_FALSE(vtks.empty());
  const auto differ = std::mismatch(ours.begin(), ours.end(), vtks.begin(), vtks.end());
  const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(differ.first - ours.begin() - 60, 0));
  EXPECT_TRUE(ours == vtks) << "'" << ours.substr(from, 120) << "' instead of '" << vtks.substr(from, 120) << "'";
}

/** What VTK writes of polydata, in the form of ours once they are unpacked. */
void
WriteByVtk(const std::filesystem::path & path, vtkPolyData * data)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  ASSERT_EQ(writer->Write(), 1);
}

void
ExpectVtksBytes(const MedialModel & model, bool keepEdges)
{
  const TemporaryFolder folder;
  WriteModel(folder / "ours.vtk", "a.vtk", model, { false, keepEdges });
  vtkNew<vtkPolyDataWriter> legacyWriter;
  legacyWriter->SetInputData(MakePolyData(model, keepEdges));
  legacyWriter->SetFileName((folder / "vtks.vtk").c_str());
  legacyWriter->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  legacyWriter->SetFileTypeToBinary();
  legacyWriter->SetHeader(("VoxelCore medial surface. SPACE=LPS Units=" + UnitName(model.unit)).c_str());
  ASSERT_EQ(legacyWriter->Write(), 1);
  ExpectSame(ReadAll(folder / "ours.vtk"), ReadAll(folder / "vtks.vtk"));

  WriteModel(folder / "ours.vtp", "a.vtp", model, { false, keepEdges });
  WriteByVtk(folder / "vtks.vtp", MakePolyData(model, keepEdges));
  ExpectSame(UnpackedVtp(ReadAll(folder / "ours.vtp")), ReadAll(folder / "vtks.vtp"));
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

TEST(PlainFiles, OfPolyDataThatIsNoModelHaveTheBytesOfVtksWriterAfterItsReader)
{
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64                        random(seed);
  std::uniform_real_distribution<double> real(-9, 9);
  const TemporaryFolder                  folder;
  for (int turn = 0; turn < 20; ++turn)
  {
    VtpContent          content;
    const auto          points = 1 + random() % 20;
    std::vector<double> numbers;
    for (std::uint64_t point = 0; point < points; ++point)
    {
      content.positions.insert(content.positions.end(), { real(random), real(random), real(random) });
      numbers.push_back(point == 3 ? std::numeric_limits<double>::infinity() : real(random));
    }
    std::vector<std::int64_t> cells;
    for (std::size_t dimension = 0; dimension < 3; ++dimension)
    {
      VtpCells & kind = content.cells[dimension];
      for (std::uint64_t cell = random() % 4; cell > 0; --cell)
      {
        for (std::uint64_t corners = dimension + 1 + random() % 5; corners > 0; --corners)
        {
          kind.points.push_back(static_cast<std::int64_t>(random() % points));
        }
        kind.offsets.push_back(static_cast<std::int64_t>(kind.points.size()));
        cells.push_back(static_cast<std::int64_t>(random()));
      }
    }
    content.texts = { { "SPACE", "LPS" }, { "Units", "mm" } };
    content.pointArrays = { { "Numbers", numbers } };
    content.cellArrays = { { "Wholes", cells }, { "Reals", std::vector<double>(cells.size(), 1.0 / 3) } };
    WriteVtp(folder / "ours.vtp", content);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder / "ours.vtp").c_str());
    reader->Update();
    WriteByVtk(folder / "vtks.vtp", reader->GetOutput());
    ExpectSame(UnpackedVtp(ReadAll(folder / "ours.vtp")), ReadAll(folder / "vtks.vtp"));
  }
}

TEST(PlainFiles, OfManyBlocksAreOneInAnyNumberOfThreadsAndWhatTheyWereForUsAndVtk)
{
  MedialModel model = MixedModel();
  model.parts = { model.parts[1] };
  model.parts.front().core = MakeCore(100000, {}, {}); // points take 2.3 blocks
  const TemporaryFolder folder;
  const int             most = omp_get_max_threads();
  for (const int threads : { 1, 3 })
  {
    omp_set_num_threads(threads);
    WriteModel(folder / ("by" + std::to_string(threads)), "a.vtp", model);
  }
  omp_set_num_threads(most);
  EXPECT_EQ(ReadAll(folder / "by1"), ReadAll(folder / "by3"));
  EXPECT_LT(ReadAll(folder / "by1").size(), UnpackedVtp(ReadAll(folder / "by1")).size() * 9 / 10);
  std::filesystem::rename(folder / "by1", folder / "a.vtp");
  EXPECT_TRUE(SameBits(ReadModel(folder / "a.vtp"), model));
  EXPECT_TRUE(RequireVtkReads(folder / "a.vtp", model));
  // As former versions wrote them.
  WriteAll(folder / "former.vtp", UnpackedVtp(ReadAll(folder / "a.vtp")));
  EXPECT_TRUE(SameBits(ReadModel(folder / "former.vtp"), model));
}
