// The filters for VTK's pipelines give what the library gives, and keep VTK's rules.

#include "ModelFixtures.h"
#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ModelPolyData.h"
#include "voxelcore/VoxelCore.h"

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkLambdaPruningFilter.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelCoreFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

struct Counter
{
  int         calls = 0;
  double      last = 0;
  bool        back = false; ///< progress went backwards
  bool        stop = false; ///< to be aborted
  std::string said;
};

unsigned long
Observe(vtkAlgorithm * filter, unsigned long event, Counter & counter)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&counter);
  command->SetCallback([](vtkObject * caller, unsigned long what, void * data, void * text) {
    auto & to = *static_cast<Counter *>(data);
    ++to.calls;
    if (what == vtkCommand::ErrorEvent)
    {
      to.said = static_cast<const char *>(text);
    }
    auto * const algorithm = vtkAlgorithm::SafeDownCast(caller);
    to.back = to.back || algorithm->GetProgress() < to.last;
    to.last = algorithm->GetProgress();
    if (to.stop)
    {
      algorithm->AbortExecuteOn();
    }
  });
  return filter->AddObserver(event, command);
}

/** Oblique, left-handed: label 2 an ellipsoid, label 5 a box. */
class VtkFilters : public ::testing::Test
{
protected:
  VtkFilters()
  {
    m_Geometry.size = { 40, 32, 32 };
    m_Geometry.spacing = { 0.5, 0.5, 1.5 };
    m_Geometry.origin = { 4, -7, 11 };
    m_Geometry.direction = { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1 };
    m_Image->SetDimensions(40, 32, 32);
    m_Image->SetSpacing(m_Geometry.spacing.data());
    m_Image->SetOrigin(m_Geometry.origin.data());
    m_Image->SetDirectionMatrix(m_Geometry.direction.data());
    m_Image->AllocateScalars(VTK_SHORT, 1);
    m_Shapes = { { 2, Ellipsoid(32) }, { 5, Box({ 4, 5, 6 }, { 34, 3, 7 }) } };
    for (int k = 0; k < 32; ++k)
    {
      for (int j = 0; j < 32; ++j)
      {
        for (int i = 0; i < 40; ++i)
        {
          *static_cast<short *>(m_Image->GetScalarPointer(i, j, k)) = m_Shapes[0].second.Contains(i, j, k)   ? 2
                                                                      : m_Shapes[1].second.Contains(i, j, k) ? 5
                                                                                                             : 0;
        }
      }
    }
    m_Core->SetInputData(m_Image);
    m_Pruned->SetInputConnection(m_Core->GetOutputPort());
  }

  MedialModel
  Expected(double lambda) const
  {
    MedialModel model;
    const auto  weights = ComputeSpacingWeights(m_Geometry.spacing);
    for (const auto & [label, shape] : m_Shapes)
    {
      const MedialComplex whole = ComputeVoxelCore(CropToVoxels(shape), weights);
      model.parts.push_back(ToPhysical(PruneByLambda(whole, { lambda }).front(), m_Geometry, label));
    }
    return model;
  }

  ImageGeometry                                    m_Geometry;
  std::vector<std::pair<std::int64_t, VoxelShape>> m_Shapes;
  vtkNew<vtkImageData>                             m_Image;
  vtkNew<vtkVoxelCoreFilter>                       m_Core;
  vtkNew<vtkLambdaPruningFilter>                   m_Pruned;
};

TEST_F(VtkFilters, GiveTheLibrarysBits)
{
  m_Core->Update();
  EXPECT_TRUE(SameBits(ModelFromPolyData(*m_Core->GetOutput()), Expected(0)));
  for (const double lambda : { 1.0, 0.6, 2.0 }) // up and down: each from the whole core
  {
    m_Pruned->SetLambda(lambda);
    m_Pruned->Update();
    EXPECT_TRUE(SameBits(ModelFromPolyData(*m_Pruned->GetOutput()), Expected(lambda))) << lambda;
  }
}

TEST_F(VtkFilters, AnotherLambdaDoesNotComputeTheCoreAgain)
{
  Counter core;
  Observe(m_Core, vtkCommand::StartEvent, core);
  m_Pruned->Update();
  m_Pruned->SetLambda(1);
  m_Pruned->Update();
  EXPECT_EQ(core.calls, 1);
}

TEST_F(VtkFilters, SettingWhatIsSetChangesNothing)
{
  const auto core = m_Core->GetMTime();
  const auto pruned = m_Pruned->GetMTime();
  m_Core->SetLabel(0);
  m_Pruned->SetLambda(0);
  EXPECT_EQ(m_Core->GetMTime(), core);
  EXPECT_EQ(m_Pruned->GetMTime(), pruned);
  m_Core->SetLabel(2);
  m_Pruned->SetLambda(0.5);
  EXPECT_GT(m_Core->GetMTime(), core);
  EXPECT_GT(m_Pruned->GetMTime(), pruned);
}

TEST_F(VtkFilters, AChangedImageIsComputedAnew)
{
  m_Pruned->Update();
  const vtkIdType before = m_Pruned->GetOutput()->GetNumberOfPoints();
  for (int i = 0; i < 40; ++i)
  {
    *static_cast<short *>(m_Image->GetScalarPointer(i, 31, 31)) = 9;
  }
  m_Image->Modified();
  m_Pruned->Update();
  EXPECT_GT(m_Pruned->GetOutput()->GetNumberOfPoints(), before);
}

TEST_F(VtkFilters, PrintTheirParameters)
{
  m_Core->SetLabel(5);
  m_Pruned->SetLambda(0.75);
  std::ostringstream core;
  std::ostringstream pruned;
  m_Core->Print(core);
  m_Pruned->Print(pruned);
  EXPECT_NE(core.str().find("vtkVoxelCoreFilter ("), std::string::npos);
  EXPECT_NE(core.str().find("Label: 5\n"), std::string::npos);
  EXPECT_NE(pruned.str().find("vtkLambdaPruningFilter ("), std::string::npos);
  EXPECT_NE(pruned.str().find("Lambda: 0.75\n"), std::string::npos);
}

TEST_F(VtkFilters, ReportProgressThatOnlyGrows)
{
  Counter core;
  Counter pruned;
  Observe(m_Core, vtkCommand::ProgressEvent, core);
  Observe(m_Pruned, vtkCommand::ProgressEvent, pruned);
  m_Pruned->SetLambda(1);
  m_Pruned->Update();
  for (const Counter & counter : { core, pruned })
  {
    EXPECT_GT(counter.calls, 4);
    EXPECT_FALSE(counter.back);
    EXPECT_EQ(counter.last, 1.0);
  }
}

TEST_F(VtkFilters, AreEmptyAfterAnAbortAndRightAfterTheNextUpdate)
{
  for (vtkAlgorithm * const stopped :
       { static_cast<vtkAlgorithm *>(m_Core.Get()), static_cast<vtkAlgorithm *>(m_Pruned.Get()) })
  {
    Counter stop;
    stop.stop = true;
    Counter             errors;
    const unsigned long tag = Observe(stopped, vtkCommand::ProgressEvent, stop);
    Observe(stopped, vtkCommand::ErrorEvent, errors);
    m_Pruned->SetLambda(1);
    m_Core->Modified();
    stopped->Update();
    EXPECT_EQ(vtkPolyData::SafeDownCast(stopped->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
    EXPECT_LE(stop.calls, 2); // VTK's own at the start, and the first of ours
    EXPECT_EQ(errors.calls, 0);
    stopped->RemoveObserver(tag);
    stopped->Modified();
  }
  m_Pruned->Update();
  EXPECT_TRUE(SameBits(ModelFromPolyData(*m_Pruned->GetOutput()), Expected(1)));
}

TEST_F(VtkFilters, WorkOnOneLabel)
{
  m_Core->SetLabel(5);
  m_Core->Update();
  const MedialModel model = ModelFromPolyData(*m_Core->GetOutput());
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].label, 5);
  EXPECT_EQ(model.parts[0].core.positions, Expected(0).parts[1].core.positions);
}

TEST_F(VtkFilters, ReportWhatIsWrongOnceAndLeaveNothing)
{
  const auto refused = [&](vtkAlgorithm * filter, const char * word) {
    Counter             errors;
    const unsigned long tag = Observe(filter, vtkCommand::ErrorEvent, errors);
    filter->Update();
    filter->RemoveObserver(tag);
    return errors.calls == 1 && errors.said.find(word) != std::string::npos &&
           vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints() == 0;
  };
  m_Core->SetLabel(99);
  EXPECT_TRUE(refused(m_Core, "label 99 does not occur"));
  m_Core->SetLabel(0);
  *static_cast<short *>(m_Image->GetScalarPointer(0, 0, 0)) = -3;
  m_Image->Modified();
  EXPECT_TRUE(refused(m_Core, "labels are whole numbers from 0"));

  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  m_Core->SetInputData(image);
  EXPECT_TRUE(refused(m_Core, "scalars of one component"));
  image->AllocateScalars(VTK_FLOAT, 1);
  std::fill_n(static_cast<float *>(image->GetScalarPointer()), 27, 0.0F);
  image->Modified();
  EXPECT_TRUE(refused(m_Core, "nothing but background"));
  for (const float value : { 0.5F, std::nanf(""), std::numeric_limits<float>::infinity() })
  {
    *static_cast<float *>(image->GetScalarPointer()) = value;
    image->Modified();
    EXPECT_TRUE(refused(m_Core, "labels are whole numbers from 0")) << value;
  }
  *static_cast<float *>(image->GetScalarPointer()) = 2;
  image->SetDirectionMatrix(1, 0.1, 0, 0, 1, 0, 0, 0, 1);
  EXPECT_TRUE(refused(m_Core, "not orthonormal"));
  image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
  for (const double lambda :
       { -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    m_Pruned->SetLambda(lambda);
    EXPECT_TRUE(refused(m_Pruned, "Lambda must be a length")) << lambda;
  }
  m_Pruned->SetLambda(1);
  vtkNew<vtkPolyData> foreign;
  m_Pruned->SetInputData(foreign);
  EXPECT_TRUE(refused(m_Pruned, "no medial surface of VoxelCore"));
  m_Pruned->SetInputData(MakePolyData(Expected(0), false));
  EXPECT_TRUE(refused(m_Pruned, "--keep-edges"));
}

TEST_F(VtkFilters, TakeImagesWhoseExtentBeginsElsewhere)
{
  vtkNew<vtkImageData> moved;
  moved->DeepCopy(m_Image);
  moved->SetExtent(10, 49, -3, 28, 5, 36);
  // The first voxel stays where it was.
  double first[3];
  moved->TransformIndexToPhysicalPoint(10, -3, 5, first);
  const double * const origin = m_Image->GetOrigin();
  moved->SetOrigin(2 * origin[0] - first[0], 2 * origin[1] - first[1], 2 * origin[2] - first[2]);
  m_Core->SetInputData(moved);
  m_Core->Update();
  const MedialModel model = ModelFromPolyData(*m_Core->GetOutput());
  const MedialModel expected = Expected(0);
  ASSERT_EQ(model.parts.size(), expected.parts.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    ASSERT_EQ(model.parts[p].core.positions.size(), expected.parts[p].core.positions.size());
    for (std::size_t v = 0; v < model.parts[p].core.positions.size(); ++v)
    {
      for (std::size_t a = 0; a < 3; ++a) // the origin was rounded on its way
      {
        ASSERT_NEAR(model.parts[p].core.positions[v][a], expected.parts[p].core.positions[v][a], 1e-12);
      }
    }
  }
}

#ifdef VOXELCORE_VTK_EXAMPLE
/** The example's file holds the bits of `voxelcore core --keep-edges`. */
TEST(VtkPipelineExample, WritesWhatTheProgramWrites)
{
  const TemporaryFolder folder;
  const std::string     scan = folder / "scan.mha";
  const std::string     program = VOXELCORE_PROGRAM;
  const auto            run = [](const std::string & command) { return std::system(command.c_str()); };
  ASSERT_EQ(run("'" + program + "' phantom torus --size 40 --spacing 0.5,0.5,1 -o '" + scan + "' -q"), 0);
  ASSERT_EQ(run("'" + program + "' core '" + scan + "' --lambda 1mm --keep-edges -q -o '" +
                (folder / "program.vtp").string() + "'"),
            0);
  ASSERT_EQ(
    run(std::string("'") + VOXELCORE_VTK_EXAMPLE + "' '" + scan + "' 2 1 '" + (folder / "example.vtp").string() + "'"),
    0);
  MedialModel expected = ReadModel(folder / "program.vtp");
  ASSERT_GT(expected.parts.at(0).core.cells.FaceCount(), 100U);
  expected.provenance.clear(); // a filter knows of no command
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "example.vtp").c_str());
  reader->Update();
  EXPECT_TRUE(SameBits(ModelFromPolyData(*reader->GetOutput()), expected));
}
#endif

} // namespace
} // namespace voxelcore::testing
