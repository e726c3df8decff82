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

namespace voxelcore::testing
{
namespace
{

struct Counter
{
  int    calls = 0;
  double last = 0;
  bool   stop = false;
};

void
Observe(vtkAlgorithm * filter, unsigned long event, Counter & counter)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&counter);
  command->SetCallback([](vtkObject * caller, unsigned long, void * data, void *) {
    auto & to = *static_cast<Counter *>(data);
    ++to.calls;
    if (auto * const algorithm = vtkAlgorithm::SafeDownCast(caller))
    {
      to.last = algorithm->GetProgress();
      if (to.stop)
      {
        algorithm->AbortExecuteOn();
      }
    }
  });
  filter->AddObserver(event, command);
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

TEST_F(VtkFilters, ReportProgressAndHeedAborting)
{
  Counter progress;
  Observe(m_Core, vtkCommand::ProgressEvent, progress);
  m_Core->Update();
  EXPECT_GT(progress.calls, 2);
  vtkNew<vtkVoxelCoreFilter> stopped;
  Counter                    stop;
  stop.stop = true;
  stopped->SetInputData(m_Image);
  Observe(stopped, vtkCommand::ProgressEvent, stop);
  stopped->Update();
  EXPECT_EQ(stopped->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(VtkFilters, WorkOnOneLabelAndRefuseWhatIsNone)
{
  m_Core->SetLabel(5);
  m_Core->Update();
  const MedialModel model = ModelFromPolyData(*m_Core->GetOutput());
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].label, 5);
  Counter errors;
  Observe(m_Core, vtkCommand::ErrorEvent, errors);
  m_Core->SetLabel(99);
  m_Core->Update();
  *static_cast<short *>(m_Image->GetScalarPointer(0, 0, 0)) = -3;
  m_Image->Modified();
  m_Core->SetLabel(0);
  m_Core->Update();
  EXPECT_EQ(errors.calls, 2);
  EXPECT_EQ(m_Core->GetOutput()->GetNumberOfPoints(), 0);
}

} // namespace
} // namespace voxelcore::testing
