#include "ItkPipelineFixtures.h"

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkMultiThreaderBase.h"

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <omp.h>

#include <cstdlib>
#include <limits>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** `core`, in lattice coordinates, is that of the object. */
void
ExpectCoreOf(const itk::MedialComplexObject & cores, std::int64_t label, MedialComplex core)
{
  ExpectSameCore(PlaceInLps(std::move(core), cores.GetGeometry()), cores.GetCore(label).core);
}

double
LambdaOf(const itk::MedialComplexObject & cores, std::int64_t label)
{
  return cores.GetPart(label).core->numbers.lambdaMm;
}

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
      ExpectCoreOf(*pipeline.core->GetOutput(), label.value, core);
      EXPECT_EQ(part.core->core.label, label.value);
      EXPECT_EQ(part.origin.name, label.name);
      EXPECT_EQ(part.origin.voxels, label.voxels);
      const VoxelBox tight = CropToVoxels(label.shape).Box();
      EXPECT_EQ(part.origin.box.lower, tight.lower);
      EXPECT_EQ(part.origin.box.size, tight.size);
      EXPECT_EQ(part.origin.shape, ComputeShapeTopology(label.shape));
      EXPECT_EQ(part.origin.core.topology, part.origin.shape);
      EXPECT_EQ(part.core->numbers.lambdaMm, 0.0);
      const auto & prunedPart = pipeline.pruned->GetOutput()->GetPart(label.value);
      ExpectCoreOf(*pipeline.pruned->GetOutput(), label.value, PruneByLambda(core, { 1.0 }).front());
      EXPECT_LT(prunedPart.core->numbers.complex.faces, core.cells.FaceCount());
      EXPECT_EQ(prunedPart.core->numbers.lambdaMm, 1.0);
      EXPECT_EQ(prunedPart.core->numbers.complex.topology, part.origin.shape);
    }
  }
}

TEST(ItkCoreFilters, HaveTheNumbersOfOneRequest)
{
  Pipeline pipeline;
  pipeline.pruned->SetLambda("2vox");
  pipeline.pruned->Update();
  for (const LabelShape & label : pipeline.shapes->GetLabels())
  {
    CertifiedRequest request;
    request.lambdas = { ParseLambda("2vox") };
    const CertifiedResult asked = ComputeCertified(label.shape, pipeline.shapes->GetGeometry(), request);
    const auto &          part = pipeline.pruned->GetOutput()->GetPart(label.value);
    const CoreNumbers &   numbers = asked.cores.front().numbers;
    ExpectSameCore(asked.cores.front().core.core, part.core->core.core);
    const CorePruning expected{ numbers.lambda, numbers.lambdaMm, numbers.complex };
    const CorePruning found{ part.core->numbers.lambda, part.core->numbers.lambdaMm, part.core->numbers.complex };
    const auto        origin = OriginOf(asked, label.value, label.name, label.voxels);
    EXPECT_EQ(CoreProvenanceJson(pipeline.shapes->GetGeometry(), { origin }, { expected }, true),
              CoreProvenanceJson(pipeline.shapes->GetGeometry(), { part.origin }, { found }, true));
  }
}

TEST(ItkCoreFilters, GiveByDefaultWhatARequestThatSaysNothingGives)
{
  Pipeline pipeline;
  pipeline.core->WholeCoreOff();
  EXPECT_EQ(pipeline.core->GetTolerance(), kUsualTolerance);
  for (const bool refine : { true, false })
  {
    pipeline.core->SetRefine(refine);
    pipeline.core->Update();
    for (const LabelShape & label : pipeline.shapes->GetLabels())
    {
      CertifiedRequest request;
      if (!refine)
      {
        request.surface = SurfaceSource();
      }
      const CertifiedResult asked = ComputeCertified(label.shape, pipeline.shapes->GetGeometry(), request);
      const auto &          part = pipeline.core->GetOutput()->GetPart(label.value);
      ExpectSameCore(asked.cores.front().core.core, part.core->core.core);
      EXPECT_EQ(asked.cores.front().core.displacement, part.core->core.displacement);
      EXPECT_EQ(part.core->core.displacement.empty(), !refine);
    }
    EXPECT_EQ(pipeline.core->GetOutput()->GetRefined(), refine ? "labels" : "");
    const std::string record = pipeline.core->GetOutput()->GetProvenance();
    EXPECT_NE(record.find("\"tolerance\":[\"1.2diag\"]"), std::string::npos) << record;
    EXPECT_EQ(record.find("\"refine\":\"labels\"") != std::string::npos, refine) << record;
  }
  EXPECT_THROW(pipeline.core->SetTolerance("wide"), itk::ExceptionObject);
  EXPECT_THROW(pipeline.pruned->Update(), itk::ExceptionObject) << "by lambda whole cores are pruned";
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

TEST(ItkCoreFilters, TheRecordSaysByWhichConnectivityAShapeWasMade)
{
  Pipeline pipeline;
  pipeline.pruned->Update();
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetProvenance(false).find("connectivity"), std::string::npos);
  std::vector<LabelShape> labels = pipeline.shapes->GetLabels();
  EXPECT_TRUE(ConnectLabels(labels, pipeline.shapes->GetGeometry(), Connectivity::Joined, "shapes").empty());
  pipeline.shapes->SetLabels(labels);
  pipeline.pruned->Update();
  EXPECT_NE(pipeline.pruned->GetOutput()->GetProvenance(false).find("\"connectivity\":\"joined\""), std::string::npos);
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
      const double mm = LambdaInMillimetres(ParseLambda(text), weights, kSpacing, CropToVoxels(label.shape).Box());
      EXPECT_EQ(LambdaOf(*pipeline.pruned->GetOutput(), label.value), mm);
      ExpectSameCore(PruneByLambda(pipeline.core->GetOutput()->GetCore(label.value).core, { mm }).front(),
                     pipeline.pruned->GetOutput()->GetCore(label.value).core);
    }
  }
  pipeline.pruned->SetLambda(1.0 / 3);
  pipeline.pruned->Update();
  EXPECT_EQ(LambdaOf(*pipeline.pruned->GetOutput(), 2), 1.0 / 3);
  // 0 passes the very same cores on.
  pipeline.pruned->SetLambda("0");
  pipeline.pruned->Update();
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(2).core, pipeline.core->GetOutput()->GetPart(2).core);
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
  ExpectSameCore(PruneByLambda(pipeline.core->GetOutput()->GetCore(2).core, { 1.5 }).front(),
                 further->GetOutput()->GetCore(2).core);
  // What is gone is gone, and it says so.
  EXPECT_EQ(less->GetOutput()->GetPart(2).core, further->GetOutput()->GetPart(2).core);
  EXPECT_EQ(LambdaOf(*less->GetOutput(), 2), 1.5);
}

TEST(ItkCoreFilters, RunOnlyWhenSomethingUpstreamChanged)
{
  Pipeline pipeline;
  pipeline.ExpectRuns(1, 1);
  pipeline.ExpectRuns(1, 1);
  const auto whole = pipeline.core->GetOutput()->GetPart(2).core;
  pipeline.pruned->SetLambda("2vox");
  pipeline.ExpectRuns(1, 2);
  EXPECT_EQ(pipeline.core->GetOutput()->GetPart(2).core, whole);
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
  ExpectCoreOf(*pipeline.core->GetOutput(), 2, CoreOf(labels[0].shape));
  EXPECT_EQ(LambdaOf(*pipeline.pruned->GetOutput(), 2), 2.0);
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
    auto filter = itk::VoxelCoreFilter::New();
    int  working = 0;
    filter->AddObserver(itk::ProgressEvent(), [&working, filter = filter.GetPointer()](const itk::EventObject &) {
      working = filter->GetProgress() > 0 && working == 0 ? omp_get_max_threads() : working;
    });
    filter->SetInput(TwoShapes());
    filter->GetMultiThreader()->SetMaximumNumberOfThreads(threads);
    filter->SetNumberOfWorkUnits(workUnits);
    filter->Update();
    // What the multi-threader has may be more than was asked for: its pool never shrinks.
    EXPECT_EQ(working, static_cast<int>(std::min(workUnits, filter->GetMultiThreader()->GetMaximumNumberOfThreads())));
    return filter->GetOutput()->GetPart(2).core;
  };
  const auto one = run(1, 5);
  ExpectSameCore(one->core.core, run(3, 8)->core.core);
  ExpectSameCore(one->core.core, run(200, 2)->core.core);
  EXPECT_EQ(omp_get_max_threads(), before);
}

TEST(ItkCoreFilters, NothingWithoutCertificateComesOut)
{
  Pipeline pipeline;
  for (const char * fault : { "core", "pruning" })
  {
    pipeline.core->Modified();
    setenv("VOXELCORE_SEEDED_FAULT", fault, 1);
    const std::string message = ThrownBy([&] { pipeline.pruned->Update(); });
    unsetenv("VOXELCORE_SEEDED_FAULT");
    EXPECT_EQ(message.find("label 2 (label-2): certificate failed: the shape has chi/b0/b1/b2 1/1/0/0, its core "), 0U)
      << message;
    EXPECT_TRUE(pipeline.pruned->GetOutput()->GetParts().empty());
    EXPECT_EQ(pipeline.core->GetOutput()->GetParts().empty(), std::string(fault) == "core");
  }

  // A core that does not belong to the shape it came with.
  pipeline.core->Update();
  auto parts = pipeline.core->GetOutput()->GetParts();
  parts[0].origin.shape.betti[1] = 1;
  auto claimed = itk::MedialComplexObject::New();
  claimed->CopyInformation(pipeline.core->GetOutput());
  claimed->SetParts(parts);
  for (const char * lambda : { "0", "1.5vox" })
  {
    auto filter = itk::LambdaPruningFilter::New();
    filter->SetInput(claimed);
    filter->SetLambda(lambda);
    EXPECT_EQ(ThrownBy([&] { filter->Update(); }).find("label 2 (label-2): certificate failed"), 0U);
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
  core->WholeCoreOn();
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
  ExpectCoreOf(*core->GetOutput(), 1, CoreOf(Box({ 9, 8, 7 })));
  EXPECT_EQ(LambdaOf(*pruned->GetOutput(), 1), 1.5);
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
