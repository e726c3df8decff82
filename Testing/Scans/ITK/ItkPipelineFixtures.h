#pragma once
// Shapes, and the pipeline that prunes their cores.

#include "ItkFixtures.h"
#include "VoxelCoreTesting/Cores.h"

#include "itkLambdaPruningFilter.h"
#include "itkVoxelCoreFilter.h"

namespace voxelcore::testing
{

inline LabelShape
Label(std::int64_t value, VoxelShape shape)
{
  LabelShape label;
  label.value = value;
  label.name = "label-" + std::to_string(value);
  label.voxels = shape.CountVoxels();
  label.shape = std::move(shape);
  return label;
}

inline constexpr Spacing3 kSpacing{ 0.5, 0.5, 2 };

/** Two labels, made by hand: an ellipsoid, and voxels at random in 20 x 14 x 9. */
inline itk::VoxelShapeObject::Pointer
TwoShapes(const Spacing3 & spacing = kSpacing)
{
  ImageGeometry geometry;
  geometry.size = { 24, 24, 24 };
  geometry.spacing = spacing;
  geometry.origin = { 1, 2, 3 };
  Random random(20261121);
  auto   shapes = itk::VoxelShapeObject::New();
  shapes->SetGeometry(geometry);
  shapes->SetStartIndex({ { 4, 5, 6 } });
  std::vector<LabelShape> labels;
  labels.push_back(Label(9, RandomShape(random, { 20, 14, 9 }, 0.6)));
  labels.push_back(Label(2, Ellipsoid(24)));
  shapes->SetLabels(std::move(labels));
  return shapes;
}

/** shapes -> core -> pruned, each watched. */
struct Pipeline
{
  itk::VoxelShapeObject::Pointer    shapes = TwoShapes();
  itk::VoxelCoreFilter::Pointer     core = itk::VoxelCoreFilter::New();
  itk::LambdaPruningFilter::Pointer pruned = itk::LambdaPruningFilter::New();
  Watcher                           coreWatcher{ core };
  Watcher                           prunedWatcher{ pruned };

  Pipeline()
  {
    core->SetInput(shapes);
    core->WholeCoreOn();
    pruned->SetInput(core->GetOutput());
  }
  void
  ExpectRuns(int ofCore, int ofPruned)
  {
    pruned->Update();
    EXPECT_EQ(coreWatcher.starts, ofCore);
    EXPECT_EQ(prunedWatcher.starts, ofPruned);
  }
};

} // namespace voxelcore::testing
