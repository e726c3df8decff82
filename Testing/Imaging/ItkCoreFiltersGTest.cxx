#include "ItkPipelineFixtures.h"

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkMultiThreaderBase.h"

#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ShapeTopology.h"

#include <omp.h>

#include <limits>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** A filter whose cores lack their last polygon. */
class DamagingFilter : public itk::VoxelCoreFilter
{
public:
  using Self = DamagingFilter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

protected:
  MedialComplex
  ComputeCore(const VoxelShape &       shape,
              const SpacingWeights &   weights,
              const ProgressCallback & progress) const override
  {
    MedialComplex core = itk::VoxelCoreFilter::ComputeCore(shape, weights, progress);
    core.cells.faceOffsets.pop_back();
    core.cells.faceVertices.resize(core.cells.faceOffsets.back());
    core.cells.faceEdges.resize(core.cells.faceOffsets.back());
    core.faceLambda.pop_back();
    return core;
  }
};

} // namespace

TEST(ItkCoreFilters, HaveTheLibrarysBits)
{
  for (const Engine engine : { Engine::Auto, Engine::Lattice, Engine::TetGen })
  {
    if (!HasEngine(engine))
    {
      continue;
    }
    Pipeline pipeline;
    pipeline.core->SetEngine(engine);
    pipeline.pruned->SetLambda("2vox");
    pipeline.pruned->Update();
    const auto weights = ComputeSpacingWeights(kSpacing);
    ASSERT_EQ(pipeline.core->GetOutput()->GetParts().size(), 2U);
    for (const LabelShape & label : pipeline.shapes->GetLabels())
    {
      const auto & part = pipeline.core->GetOutput()->GetPart(label.value);
      const auto   core = ComputeVoxelCore(label.shape, weights);
      ExpectSameCore(core, *part.complex);
      EXPECT_EQ(part.name, label.name);
      EXPECT_EQ(part.box.lower, label.shape.Box().lower);
      EXPECT_EQ(part.box.size, label.shape.Box().size);
      EXPECT_EQ(part.shapeTopology, ComputeShapeTopology(label.shape));
      EXPECT_EQ(part.complexTopology, part.shapeTopology);
      EXPECT_EQ(part.lambda, 0.0);
      const auto & prunedPart = pipeline.pruned->GetOutput()->GetPart(label.value);
      ExpectSameCore(PruneByLambda(core, { 1.0 }).front(), *prunedPart.complex);
      EXPECT_LT(prunedPart.complex->cells.FaceCount(), core.cells.FaceCount());
      EXPECT_EQ(prunedPart.lambda, 1.0);
      EXPECT_EQ(prunedPart.complexTopology, part.shapeTopology);
    }
  }
}

TEST(ItkCoreFilters, GeometryGoesThrough)
{
  Pipeline pipeline;
  pipeline.pruned->Update();
  for (const auto * output : { pipeline.core->GetOutput(), pipeline.pruned->GetOutput() })
  {
    EXPECT_EQ(output->GetGeometry().spacing, kSpacing);
    EXPECT_EQ(output->GetGeometry().origin, (Vector3{ 1, 2, 3 }));
    EXPECT_EQ(output->GetGeometry().size, (std::array<std::int64_t, 3>{ 24, 24, 24 }));
    EXPECT_EQ(output->GetStartIndex(), (ImageIndex{ { 4, 5, 6 } }));
    EXPECT_EQ(output->TransformLatticeToPhysicalPoint({ 1.5, 2.5, 3.5 }), (itk::Point<double, 3>({ 1.5, 3, 9 })));
  }
}

TEST(ItkCoreFilters, LambdaIsWhatTheCommandLineMeansByIt)
{
  Pipeline   pipeline;
  const auto weights = ComputeSpacingWeights(kSpacing);
  EXPECT_EQ(pipeline.pruned->GetLambda(), "1.5vox");
  for (const char * text : { "1.5vox", "0.75mm", "0.75", "2.5%", "3vox" })
  {
    SCOPED_TRACE(text);
    pipeline.pruned->SetLambda(text);
    pipeline.pruned->Update();
    for (const LabelShape & label : pipeline.shapes->GetLabels())
    {
      const double mm = LambdaInMillimetres(ParseLambda(text), weights, kSpacing, label.shape.Box());
      EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(label.value).lambda, mm);
      ExpectSameCore(PruneByLambda(pipeline.core->GetOutput()->GetComplex(label.value), { mm }).front(),
                     pipeline.pruned->GetOutput()->GetComplex(label.value));
    }
  }
  pipeline.pruned->SetLambda(1.0 / 3);
  pipeline.pruned->Update();
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(2).lambda, 1.0 / 3);
  // 0 passes the very same complexes on.
  pipeline.pruned->SetLambda("0");
  pipeline.pruned->Update();
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(2).complex, pipeline.core->GetOutput()->GetPart(2).complex);
}

TEST(ItkCoreFilters, PruningInStepsIsPruningAtOnce)
{
  Pipeline pipeline;
  auto     further = itk::LambdaPruningFilter::New();
  further->SetInput(pipeline.pruned->GetOutput());
  further->SetLambda("3vox");
  further->Update();
  auto less = itk::LambdaPruningFilter::New();
  less->SetInput(further->GetOutput());
  less->SetLambda("1vox");
  less->Update();
  ExpectSameCore(PruneByLambda(pipeline.core->GetOutput()->GetComplex(2), { 1.5 }).front(),
                 further->GetOutput()->GetComplex(2));
  // What is gone is gone, and it says so.
  EXPECT_EQ(less->GetOutput()->GetPart(2).complex, further->GetOutput()->GetPart(2).complex);
  EXPECT_EQ(less->GetOutput()->GetPart(2).lambda, 1.5);
}

TEST(ItkCoreFilters, RunOnlyWhenSomethingUpstreamChanged)
{
  Pipeline pipeline;
  pipeline.ExpectRuns(1, 1);
  pipeline.ExpectRuns(1, 1);
  const auto whole = pipeline.core->GetOutput()->GetPart(2).complex;
  pipeline.pruned->SetLambda("2vox");
  pipeline.ExpectRuns(1, 2);
  EXPECT_EQ(pipeline.core->GetOutput()->GetPart(2).complex, whole);
  pipeline.pruned->SetLambda("2vox");
  pipeline.core->SetEngine(Engine::Auto);
  pipeline.ExpectRuns(1, 2);
  pipeline.core->SetEngine(Engine::Lattice);
  pipeline.ExpectRuns(2, 3);
  // New shapes in the same object.
  auto labels = pipeline.shapes->GetLabels();
  labels.pop_back();
  pipeline.shapes->SetLabels(labels);
  pipeline.ExpectRuns(3, 4);
  EXPECT_FALSE(pipeline.pruned->GetOutput()->HasLabel(9));
  // Another spacing: the information alone.
  ImageGeometry geometry = pipeline.shapes->GetGeometry();
  pipeline.shapes->SetGeometry(geometry);
  pipeline.ExpectRuns(3, 4);
  geometry.spacing = { 1, 1, 1 };
  pipeline.shapes->SetGeometry(geometry);
  pipeline.ExpectRuns(4, 5);
  ExpectSameCore(CoreOf(labels[0].shape), pipeline.core->GetOutput()->GetComplex(2));
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(2).lambda, 2.0);
}

TEST(ItkCoreFilters, ReleasedDataAreMadeAgainWhenTheyAreNeeded)
{
  Pipeline pipeline;
  pipeline.core->ReleaseDataFlagOn();
  pipeline.ExpectRuns(1, 1);
  EXPECT_TRUE(pipeline.core->GetOutput()->GetDataReleased());
  EXPECT_TRUE(pipeline.core->GetOutput()->GetParts().empty());
  EXPECT_EQ(pipeline.core->GetOutput()->GetGeometry().spacing, kSpacing);
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetParts().size(), 2U);
  pipeline.ExpectRuns(1, 1);
  pipeline.pruned->SetLambda("2vox");
  pipeline.ExpectRuns(2, 2);
}

TEST(ItkCoreFilters, ProgressGoesFrom0To1)
{
  Pipeline pipeline;
  pipeline.pruned->Update();
  pipeline.coreWatcher.ExpectMonotoneFrom0To1();
  pipeline.prunedWatcher.ExpectMonotoneFrom0To1();
}

TEST(ItkCoreFilters, AbortWithoutOutputAndCanRunAgain)
{
  for (const float at : { 0.0F, 0.5F })
  {
    Pipeline pipeline;
    pipeline.coreWatcher.abortAt = at;
    EXPECT_THROW(pipeline.pruned->Update(), itk::ProcessAborted);
    EXPECT_EQ(pipeline.coreWatcher.aborts, 1);
    EXPECT_EQ(pipeline.prunedWatcher.starts, 0);
    EXPECT_TRUE(pipeline.core->GetOutput()->GetParts().empty());
    pipeline.coreWatcher.abortAt = -1;
    pipeline.prunedWatcher.abortAt = at;
    EXPECT_THROW(pipeline.pruned->Update(), itk::ProcessAborted);
    EXPECT_EQ(pipeline.prunedWatcher.aborts, 1);
    EXPECT_TRUE(pipeline.pruned->GetOutput()->GetParts().empty());
    pipeline.prunedWatcher.abortAt = -1;
    pipeline.pruned->Update();
    EXPECT_EQ(pipeline.coreWatcher.ends, 1); // the core was not lost with the pruning
    EXPECT_EQ(pipeline.pruned->GetOutput()->GetParts().size(), 2U);
  }
}

TEST(ItkCoreFilters, ThreadsAreThoseOfTheFilterAndChangeNothing)
{
  const int  before = omp_get_max_threads();
  const auto run = [](itk::ThreadIdType workUnits, itk::ThreadIdType threads) {
    class Counting : public itk::VoxelCoreFilter
    {
    public:
      using Self = Counting;
      using Pointer = itk::SmartPointer<Self>;
      itkNewMacro(Self);
      mutable int threads = 0;

    protected:
      MedialComplex
      ComputeCore(const VoxelShape &       shape,
                  const SpacingWeights &   weights,
                  const ProgressCallback & progress) const override
      {
        threads = omp_get_max_threads();
        return itk::VoxelCoreFilter::ComputeCore(shape, weights, progress);
      }
    };
    auto filter = Counting::New();
    filter->SetInput(TwoShapes());
    filter->GetMultiThreader()->SetMaximumNumberOfThreads(threads);
    filter->SetNumberOfWorkUnits(workUnits);
    filter->Update();
    // What the multi-threader has may be more than was asked for: its pool never shrinks.
    EXPECT_EQ(filter->threads,
              static_cast<int>(std::min(workUnits, filter->GetMultiThreader()->GetMaximumNumberOfThreads())));
    return filter->GetOutput()->GetPart(2).complex;
  };
  const auto one = run(1, 5);
  ExpectSameCore(*one, *run(3, 8));
  ExpectSameCore(*one, *run(200, 2));
  EXPECT_EQ(omp_get_max_threads(), before);
}

TEST(ItkCoreFilters, NothingWithoutCertificateComesOut)
{
  auto damaging = DamagingFilter::New();
  damaging->SetInput(TwoShapes());
  const std::string message = ThrownBy([&] { damaging->Update(); });
  EXPECT_EQ(message.find("label 2: certificate failed: the shape has chi/b0/b1/b2 1/1/0/0, its core has 0/1/1/0"), 0U)
    << message;
  EXPECT_TRUE(damaging->GetOutput()->GetParts().empty());

  // A complex that does not belong to the topology it came with.
  Pipeline pipeline;
  pipeline.core->Update();
  auto parts = pipeline.core->GetOutput()->GetParts();
  parts[0].shapeTopology.betti[1] = 1;
  auto claimed = itk::MedialComplexObject::New();
  claimed->CopyInformation(pipeline.core->GetOutput());
  claimed->SetParts(parts);
  for (const char * lambda : { "0", "1.5vox" })
  {
    auto filter = itk::LambdaPruningFilter::New();
    filter->SetInput(claimed);
    filter->SetLambda(lambda);
    EXPECT_EQ(ThrownBy([&] { filter->Update(); }).find("label 2: certificate failed"), 0U);
    EXPECT_TRUE(filter->GetOutput()->GetParts().empty());
  }
}

TEST(ItkCoreFilters, WorkAgainAfterAFailureUpstream)
{
  using ImageType = itk::Image<std::int16_t, 3>;
  auto source = SpySource<ImageType>::New();
  source->size = { { 9, 8, 7 } };
  auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
  shapes->SetInput(source->GetOutput());
  shapes->SetNumberOfStreamDivisions(3);
  auto core = itk::VoxelCoreFilter::New();
  core->SetInput(shapes->GetOutput());
  auto pruned = itk::LambdaPruningFilter::New();
  pruned->SetInput(core->GetOutput());
  const auto expectRefusal = [&](const char * words) {
    source->Modified();
    for (int round = 0; round < 2; ++round)
    {
      EXPECT_NE(ThrownBy([&] { pruned->Update(); }).find(words), std::string::npos);
    }
  };
  source->value = [](int x, int, int) { return -x; };
  expectRefusal("value -1 at voxel (1,0,0) is negative"); // while voxels are made
  source->value = [](int, int, int) { return 1; };
  source->placement.direction[1] = 0.5;
  expectRefusal("skewed"); // while information goes down
  source->placement.direction[1] = 0;
  source->failInformation = true;
  expectRefusal("the source has no information");
  source->failInformation = false;
  source->failEnlarging = true;
  expectRefusal("the source has no more");
  source->failEnlarging = false;
  source->failAt = 1;
  source->regions.clear();
  source->Modified();
  EXPECT_NE(ThrownBy([&] { pruned->Update(); }).find("the source failed"), std::string::npos);
  source->failAt = -1;
  pruned->Update();
  ExpectSameCore(CoreOf(Box({ 9, 8, 7 })), core->GetOutput()->GetComplex(1));
  EXPECT_EQ(pruned->GetOutput()->GetPart(1).lambda, 1.5);
}

TEST(ItkCoreFilters, RefuseInOneLine)
{
  auto pruning = itk::LambdaPruningFilter::New();
  pruning->SetLambda("2vox");
  for (const char * text : { "", "-1", "1.5 furlongs", "nan", "1e999" })
  {
    const std::string message = ThrownBy([&] { pruning->SetLambda(text); });
    EXPECT_FALSE(message.empty());
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  ThrownBy([&] { pruning->SetLambda(-0.5); });
  ThrownBy([&] { pruning->SetLambda(std::numeric_limits<double>::infinity()); });
  EXPECT_EQ(pruning->GetLambda(), "2vox");
  EXPECT_THROW(pruning->Update(), itk::ExceptionObject); // no input
  EXPECT_THROW(itk::VoxelCoreFilter::New()->Update(), itk::ExceptionObject);

  auto core = itk::VoxelCoreFilter::New();
  auto shapes = TwoShapes();
  auto geometry = shapes->GetGeometry();
  geometry.spacing[1] = 0;
  shapes->SetGeometry(geometry);
  core->SetInput(shapes);
  ThrownBy([&] { core->Update(); });

  // Lengths that no weights have, and places that doubles cannot tell apart.
  geometry.spacing = { 0.0001, 1, 1 };
  shapes->SetGeometry(geometry);
  ThrownBy([&] { core->Update(); });
  geometry.spacing = { 1, 1, 1 };
  geometry.origin[0] = 1.8446744e19;
  shapes->SetGeometry(geometry);
  ThrownBy([&] { core->Update(); });
  if (!HasEngine(Engine::TetGen))
  {
    core->SetEngine(Engine::TetGen);
    EXPECT_NE(ThrownBy([&] { core->Update(); }).find("no engine tetgen"), std::string::npos);
  }
}

TEST(ItkCoreFilters, PrintTheirParameters)
{
  Pipeline pipeline;
  pipeline.pruned->SetLambda("2.5%");
  EXPECT_NE(Printed(*pipeline.pruned).find("Lambda: 2.5%"), std::string::npos);
  EXPECT_NE(Printed(*pipeline.core).find("Engine: auto"), std::string::npos);
}
