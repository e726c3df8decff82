// A program with VTK's filters beside `voxelcore`: the same bits, in the same place, in files that `voxelcore` takes.

#include "Models/Models/ModelFixtures.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkLambdaPruningFilter.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelCoreFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdlib>

namespace voxelcore::testing
{
namespace
{

class VtkPipelineExample : public ::testing::Test
{
protected:
  std::string
  At(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  /** Runs the program; arguments that name files here are given as "@name". */
  int
  Run(const std::string & arguments) const
  {
    std::string command = std::string("'") + VOXELCORE_PROGRAM + "' ";
    for (const char c : arguments)
    {
      command += c == '@' ? At("") : std::string(1, c);
    }
    return std::system((command + " -q > /dev/null").c_str());
  }

  TemporaryFolder m_Folder;
};

TEST_F(VtkPipelineExample, WritesWhatTheProgramWrites)
{
  ASSERT_EQ(Run("phantom torus --size 40 --spacing 0.5,0.5,1 -o @scan.mha"), 0);
  ASSERT_EQ(Run("core @scan.mha --lambda 1mm --keep-edges -o @program.vtp"), 0);
  const std::string example = std::string("'") + VOXELCORE_VTK_EXAMPLE + "' '";
  ASSERT_EQ(std::system((example + At("scan.mha") + "' 2 1 '" + At("example.vtp") + "'").c_str()), 0);
  MedialModel expected = ReadModel(m_Folder / "program.vtp");
  MedialModel found = ReadModel(m_Folder / "example.vtp");
  ASSERT_GT(expected.parts.at(0).core.cells.FaceCount(), 100U);
  // The records agree in all but what the scan's file says, which a filter does not see.
  auto record = nlohmann::ordered_json::parse(expected.provenance);
  record["input"]["sha256"] = "";
  record["input"]["format"] = "image in memory";
  record["input"]["notes"] = nlohmann::ordered_json::array();
  expected.provenance = found.provenance;
  EXPECT_EQ(found.provenance, record.dump());
  EXPECT_TRUE(SameBits(found, expected));
}

TEST_F(VtkPipelineExample, WritesAFileThatTheProgramTakes)
{
  ASSERT_EQ(Run("phantom torus --size 40 --spacing 0.5,0.5,1 -o @scan.mha"), 0);
  const std::string example = std::string("'") + VOXELCORE_VTK_EXAMPLE + "' '";
  ASSERT_EQ(std::system((example + At("scan.mha") + "' 2 0 '" + At("example.vtp") + "'").c_str()), 0);
  EXPECT_EQ(Run("verify @scan.mha @example.vtp"), 0);
  EXPECT_EQ(Run("prune @example.vtp --lambda 1mm -o @pruned.vtp"), 0);
  EXPECT_EQ(Run("verify @scan.mha @pruned.vtp"), 0);
  EXPECT_EQ(Run("skeleton @example.vtp -o @skeleton.vtp"), 0);
  if (std::system("command -v Xvfb > /dev/null") == 0)
  {
    EXPECT_EQ(Run("render @example.vtp -o @example.png"), 0);
  }
}

TEST_F(VtkPipelineExample, ARefinedCoreIsPrunedAsByTheProgram)
{
  ASSERT_EQ(Run("phantom ellipsoid --size 40 --spacing 0.5,0.5,1 -o @scan.mha"), 0);
  ASSERT_EQ(Run("core @scan.mha --lambda 0.5mm --refine labels --keep-edges -o @refined.vtp"), 0);
  ASSERT_EQ(Run("prune @refined.vtp --lambda 4mm --keep-edges -o @pruned.vtp"), 0);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(At("refined.vtp").c_str());
  vtkNew<vtkLambdaPruningFilter> prune;
  prune->SetInputConnection(reader->GetOutputPort());
  prune->SetLambda(4);
  prune->Update();
  const MedialModel found = ModelFromPolyData(*prune->GetOutput());
  const MedialModel expected = ReadModel(m_Folder / "pruned.vtp");
  EXPECT_EQ(found.provenance, expected.provenance);
  EXPECT_TRUE(SameBits(found, expected));
  EXPECT_LT(found.parts.at(0).displacement.size(), ReadModel(m_Folder / "refined.vtp").parts.at(0).displacement.size());
}

TEST_F(VtkPipelineExample, ARotatedNiftiLiesWhereTheProgramPutsIt)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(20, 18, 16);
  image->SetSpacing(0.5, 0.75, 1.5);
  image->AllocateScalars(VTK_SHORT, 1);
  for (int k = 0; k < 16; ++k)
  {
    for (int j = 0; j < 18; ++j)
    {
      for (int i = 0; i < 20; ++i)
      {
        const bool in = i > 2 && i < 17 && j > 3 && j < 14 && k > 2 && k < 10 + i / 5;
        *static_cast<short *>(image->GetScalarPointer(i, j, k)) = in ? 1 : 0;
      }
    }
  }
  vtkNew<vtkMatrix4x4> place; // to RAS: a turn by 40 degrees, and a tilt
  const double         rows[3][4] = { { 0.36, 0.48, -0.8, 31 }, { -0.8, 0.6, 0, -7 }, { 0.48, 0.64, 0.6, 11.5 } };
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      place->SetElement(row, column, rows[row][column]);
    }
  }
  vtkNew<vtkNIFTIImageWriter> writer;
  writer->SetInputData(image);
  writer->SetQFormMatrix(place);
  writer->SetFileName(At("scan.nii").c_str());
  writer->Write();
  ASSERT_EQ(Run("core @scan.nii --lambda 0 --keep-edges -o @program.vtp"), 0);
  const MedialModel expected = ReadModel(m_Folder / "program.vtp");

  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(At("scan.nii").c_str());
  reader->Update();
  ASSERT_NE(reader->GetQFormMatrix(), nullptr);
  vtkNew<vtkVoxelCoreFilter> core;
  core->SetInputConnection(reader->GetOutputPort());
  core->SetImageToRASMatrix(reader->GetQFormMatrix());
  core->WholeCoreOn();
  core->Update();
  const MedialModel found = ModelFromPolyData(*core->GetOutput());
  ASSERT_EQ(found.parts.size(), 1U);
  ASSERT_EQ(found.parts[0].core.positions.size(), expected.parts.at(0).core.positions.size());
  for (std::size_t v = 0; v < found.parts[0].core.positions.size(); ++v)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      // NIfTI has its quaternion in single precision, and what is made of it is rounded on the way.
      ASSERT_NEAR(found.parts[0].core.positions[v][a], expected.parts[0].core.positions[v][a], 1e-6);
    }
  }
  WriteModel(m_Folder / "found.vtp", m_Folder / "found.vtp", found, { .keepEdges = true });
  EXPECT_EQ(Run("prune @found.vtp --lambda 1mm -o @pruned.vtp"), 0);
  // By default it is what the program gives by default.
  core->WholeCoreOff();
  core->Update();
  const MedialModel usual = ModelFromPolyData(*core->GetOutput());
  ASSERT_EQ(Run("core @scan.nii --keep-edges -o @usual.vtp"), 0);
  const MedialModel asked = ReadModel(m_Folder / "usual.vtp");
  EXPECT_EQ(usual.refined, "labels");
  EXPECT_EQ(usual.refined, asked.refined);
  // Which diagonal cuts a square may differ, as the two do in single precision.
  const MedialComplex & one = usual.parts.at(0).core;
  const MedialComplex & other = asked.parts.at(0).core;
  EXPECT_EQ(one.cells.edges.size(), other.cells.edges.size());
  EXPECT_EQ(one.cells.FaceCount(), other.cells.FaceCount());
  ASSERT_EQ(one.positions.size(), other.positions.size());
  for (const auto & p : one.positions)
  {
    EXPECT_TRUE(std::any_of(other.positions.begin(),
                            other.positions.end(),
                            [&](const auto & q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < 1e-4; }))
      << "no vertex at " << p[0] << ' ' << p[1] << ' ' << p[2];
  }
  WriteModel(m_Folder / "usual-found.vtp", m_Folder / "usual-found.vtp", usual, { .keepEdges = true });
  EXPECT_EQ(Run("prune @usual-found.vtp --tolerance 2diag -o @further.vtp"), 0);
}

} // namespace
} // namespace voxelcore::testing
