// The filters for VTK's pipelines give what the library gives, and keep VTK's rules.

#include "Models/Models/ModelFixtures.h"
#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Models/ModelPolyData.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLambdaPruningFilter.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkVoxelCoreFilter.h>

#include <cmath>
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
    if (what == vtkCommand::ErrorEvent || what == vtkCommand::WarningEvent)
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
    m_Core->WholeCoreOn();
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

  /** What a filter gives, without the record of how. */
  static MedialModel
  Found(vtkPolyDataAlgorithm * filter)
  {
    MedialModel model = ModelFromPolyData(*filter->GetOutput());
    EXPECT_FALSE(model.provenance.empty());
    model.provenance.clear();
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
  EXPECT_TRUE(SameBits(Found(m_Core), Expected(0)));
  for (const double lambda : { 1.0, 0.6, 2.0 }) // up and down: each from the whole core
  {
    m_Pruned->SetLambda(lambda);
    m_Pruned->Update();
    EXPECT_TRUE(SameBits(Found(m_Pruned), Expected(lambda))) << lambda;
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
  EXPECT_NE(core.str().find("LengthsInVoxels: Off\n"), std::string::npos);
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
  EXPECT_TRUE(SameBits(Found(m_Pruned), Expected(1)));
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

TEST_F(VtkFilters, JoinPiecesThatTouchWhenAskedAndSayElseThatTheyTouch)
{
  // The box of label 5 goes on over its corner.
  for (int i = 38; i < 40; ++i)
  {
    *static_cast<short *>(m_Image->GetScalarPointer(i, 8, 13)) = 5;
  }
  m_Image->Modified();
  Counter warnings;
  Observe(m_Core, vtkCommand::WarningEvent, warnings);
  const auto made = [&] {
    m_Core->Update();
    return ModelFromPolyData(*m_Core->GetOutput()).provenance;
  };
  EXPECT_EQ(made().find("connectivity"), std::string::npos);
  EXPECT_EQ(warnings.calls, 1);
  EXPECT_NE(warnings.said.find("label 5 (label-5): 1 piece touches others over edges or corners alone"),
            std::string::npos)
    << warnings.said;
  m_Core->SetConnectivity("joined");
  const std::string joined = made();
  EXPECT_NE(joined.find("\"connectivity\":\"joined\""), std::string::npos) << joined;
  EXPECT_EQ(warnings.calls, 1);
  m_Core->SetConnectivity("18");
  Counter errors;
  Observe(m_Core, vtkCommand::ErrorEvent, errors);
  m_Core->Update();
  EXPECT_NE(errors.said.find("'18' is none"), std::string::npos) << errors.said;
}

TEST_F(VtkFilters, ReportWhatIsWrongOnceAndLeaveNothing)
{
  const auto refused = [&](vtkAlgorithm * filter, const char * word) {
    Counter             errors;
    const unsigned long tag = Observe(filter, vtkCommand::ErrorEvent, errors);
    filter->Update();
    filter->RemoveObserver(tag);
    return errors.calls == 1 && errors.said.find(word) != std::string::npos &&
           vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints() == 0 &&
           filter->GetErrorCode() != vtkErrorCode::NoError;
  };
  m_Pruned->Update();
  EXPECT_EQ(m_Core->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(m_Pruned->GetErrorCode(), vtkErrorCode::NoError);
  m_Core->SetLabel(99);
  EXPECT_TRUE(refused(m_Core, "there is no label '99'"));
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
  EXPECT_TRUE(refused(m_Core, "its axes are skewed"));
  image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
  image->SetSpacing(0.0001, 1, 1);
  EXPECT_TRUE(refused(m_Core, "0.0001 x 1 x 1 mm has no ratio"));
  image->SetSpacing(1, 1, 1);
  image->SetOrigin(1.8446744e19, 0, 0);
  EXPECT_TRUE(refused(m_Core, "correct its origin"));
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
  for (const double value : { -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    MedialModel damaged = Expected(0);
    damaged.parts.front().core.radius.front() = value;
    m_Pruned->SetInputData(MakePolyData(damaged, true));
    EXPECT_TRUE(refused(m_Pruned, "point 0 has the Radius")) << value;
    damaged = Expected(0);
    damaged.parts.front().core.faceLambda.front() = value;
    m_Pruned->SetInputData(MakePolyData(damaged, true));
    EXPECT_TRUE(refused(m_Pruned, "a measure Lambda of its faces")) << value;
  }
}

TEST_F(VtkFilters, AreWithoutErrorAgainAfterAFault)
{
  m_Core->SetLabel(99);
  Counter errors;
  Observe(m_Core, vtkCommand::ErrorEvent, errors);
  m_Core->Update();
  EXPECT_NE(m_Core->GetErrorCode(), vtkErrorCode::NoError);
  m_Core->SetLabel(5);
  m_Core->Update();
  EXPECT_EQ(m_Core->GetErrorCode(), vtkErrorCode::NoError);
}

TEST_F(VtkFilters, SayWhereThePointsLieOnlyWhereItIsKnown)
{
  const auto isSaid = [&] {
    m_Pruned->Update();
    const bool core = m_Core->GetOutput()->GetFieldData()->GetAbstractArray("SPACE") != nullptr;
    const bool pruned = m_Pruned->GetOutput()->GetFieldData()->GetAbstractArray("SPACE") != nullptr;
    EXPECT_EQ(core, pruned);
    EXPECT_GT(m_Pruned->GetOutput()->GetNumberOfPoints(), 0);
    return core;
  };
  m_Core->SetLabel(5);
  EXPECT_TRUE(isSaid()); // a direction that is one
  m_Image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
  m_Image->Modified();
  EXPECT_FALSE(isSaid()); // perhaps what a reader left of it
  m_Core->ImageIsInLPSOn();
  EXPECT_TRUE(isSaid());
  m_Core->ImageIsInLPSOff();
  vtkNew<vtkMatrix4x4> matrix;
  m_Core->SetImageToLPSMatrix(matrix);
  EXPECT_TRUE(isSaid());
  m_Core->SetImageToRASMatrix(nullptr);
  EXPECT_FALSE(isSaid());
}

TEST_F(VtkFilters, SayVoxelsWhereTheScanGaveNoVoxelSize)
{
  const auto unit = [&] {
    m_Pruned->Update();
    const MedialModel core = ModelFromPolyData(*m_Core->GetOutput());
    EXPECT_EQ(core.unit, ModelFromPolyData(*m_Pruned->GetOutput()).unit);
    EXPECT_EQ(core.provenance.find("area_vox2") != std::string::npos, core.unit == SpatialUnit::Voxels);
    EXPECT_EQ(core.provenance.find("mm") == std::string::npos, core.unit == SpatialUnit::Voxels);
    return core.unit;
  };
  m_Core->SetLabel(5);
  EXPECT_EQ(unit(), SpatialUnit::Millimetres);
  m_Core->LengthsInVoxelsOn();
  EXPECT_EQ(unit(), SpatialUnit::Voxels);
  m_Core->LengthsInVoxelsOff();
  EXPECT_EQ(unit(), SpatialUnit::Millimetres);
  vtkNew<vtkStringArray> units;
  units->SetName("Units");
  units->InsertNextValue("voxel");
  m_Image->GetFieldData()->AddArray(units);
  m_Image->Modified();
  EXPECT_EQ(unit(), SpatialUnit::Voxels);
  units->SetValue(0, "mm");
  m_Image->Modified();
  EXPECT_EQ(unit(), SpatialUnit::Millimetres);
  units->SetValue(0, "um");
  m_Image->Modified();
  Counter errors;
  Observe(m_Core, vtkCommand::ErrorEvent, errors);
  m_Core->Update();
  EXPECT_EQ(errors.calls, 1);
  EXPECT_NE(errors.said.find("must say mm or voxel, not 'um'"), std::string::npos) << errors.said;
  EXPECT_EQ(m_Core->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(VtkFilters, AMatrixPlacesPointsAsADirectionDoes)
{
  for (const std::array<double, 9> & direction :
       std::initializer_list<std::array<double, 9>>{ { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1 },
                                                     { 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6 },
                                                     { 0, 0, 1, -1, 0, 0, 0, -1, 0 },
                                                     { -1, 0, 0, 0, 1, 0, 0, 0, 1 } })
  {
    m_Geometry.direction = direction;
    const MedialModel    expected = Expected(0);
    vtkNew<vtkImageData> bare; // as a reader leaves it that knows of no direction
    bare->DeepCopy(m_Image);
    bare->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
    bare->SetOrigin(0, 0, 0);
    vtkNew<vtkMatrix4x4> toLps;
    vtkNew<vtkMatrix4x4> toRas;
    for (int row = 0; row < 3; ++row)
    {
      const double sign = row < 2 ? -1 : 1;
      for (int column = 0; column < 4; ++column)
      {
        const auto   r = static_cast<std::size_t>(row);
        const double value = column < 3 ? direction[3 * r + static_cast<std::size_t>(column)] : m_Geometry.origin[r];
        toLps->SetElement(row, column, value);
        toRas->SetElement(row, column, sign * value);
      }
    }
    m_Core->SetInputData(bare);
    for (const bool ras : { false, true })
    {
      ras ? m_Core->SetImageToRASMatrix(toRas) : m_Core->SetImageToLPSMatrix(toLps);
      m_Core->Update();
      const MedialModel found = Found(m_Core);
      ASSERT_EQ(found.parts.size(), expected.parts.size());
      for (std::size_t p = 0; p < found.parts.size(); ++p)
      {
        const MedialComplex & is = found.parts[p].core;
        const MedialComplex & should = expected.parts[p].core;
        ASSERT_EQ(is.cells.faceVertices, should.cells.faceVertices);
        for (std::size_t v = 0; v < is.positions.size(); ++v)
        {
          for (std::size_t a = 0; a < 3; ++a)
          {
            ASSERT_NEAR(is.positions[v][a], should.positions[v][a], 1e-9);
          }
        }
      }
    }
  }
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

} // namespace
} // namespace voxelcore::testing
