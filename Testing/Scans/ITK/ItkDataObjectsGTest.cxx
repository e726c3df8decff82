#include "ItkPipelineFixtures.h"

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ItkDataObjects, ShapesAreSortedFoundAndChecked)
{
  const auto shapes = TwoShapes();
  ASSERT_EQ(shapes->GetLabels().size(), 2U);
  EXPECT_EQ(shapes->GetLabels()[0].value, 2);
  EXPECT_EQ(shapes->GetLabel(9).name, "label-9");
  EXPECT_FALSE(shapes->HasLabel(3));
  EXPECT_NE(ThrownBy([&] { shapes->GetLabel(3); }).find("there is no label 3"), std::string::npos);
  EXPECT_NE(ThrownBy([&] {
              shapes->SetLabels({ Label(1, Box({ 1, 1, 1 })), Label(1, Box({ 1, 1, 1 })) });
            }).find("label 1 is given twice"),
            std::string::npos);
  EXPECT_NE(ThrownBy([&] {
              shapes->SetLabels({ Label(1, Box({ 25, 1, 1 })) });
            }).find("reaches beyond the image"),
            std::string::npos);
  EXPECT_EQ(shapes->GetLabels().size(), 2U); // as it was
}

TEST(ItkDataObjects, GraftingSharesAndInitializeLetsGo)
{
  Pipeline pipeline;
  pipeline.core->Update();
  const auto check = [](auto & original, const auto & contents, itk::DataObject * other) {
    using TObject = std::remove_reference_t<decltype(original)>;
    auto       graft = TObject::New();
    const auto before = graft->GetMTime();
    graft->Graft(&original);
    EXPECT_GT(graft->GetMTime(), before);
    EXPECT_EQ(contents(*graft).data(), contents(original).data()); // the same memory
    EXPECT_EQ(graft->GetGeometry().spacing, original.GetGeometry().spacing);
    EXPECT_EQ(graft->GetStartIndex(), original.GetStartIndex());
    const auto after = graft->GetMTime();
    graft->Graft(&original);
    EXPECT_EQ(graft->GetMTime(), after);
    const std::size_t size = contents(original).size();
    graft->Initialize();
    EXPECT_TRUE(contents(*graft).empty());
    EXPECT_EQ(graft->GetGeometry().spacing, original.GetGeometry().spacing);
    EXPECT_EQ(contents(original).size(), size);
    EXPECT_NE(ThrownBy([&] { graft->Graft(other); }).find("can be grafted"), std::string::npos);
    EXPECT_NE(ThrownBy([&] { graft->Graft(nullptr); }).find("can be grafted"), std::string::npos);
    const std::string text = Printed(original);
    for (const char * words : { "Spacing: 0.5 0.5 2",
                                "Origin: 1 2 3",
                                "Size: 24 24 24",
                                "StartIndex: [4, 5, 6]",
                                "2 (label-2): ",
                                "9 (label-9): " })
    {
      EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
  };
  auto & cores = *pipeline.core->GetOutput();
  check(
    *pipeline.shapes,
    [](const auto & object) -> auto & { return object.GetLabels(); },
    &cores);
  check(
    cores,
    [](const auto & object) -> auto & { return object.GetParts(); },
    pipeline.shapes);
  EXPECT_NE(Printed(cores).find("Euler number 1, Betti numbers 1 0 0; core: Euler number 1, Betti numbers 1 0 0"),
            std::string::npos);
}

TEST(ItkDataObjects, ADisconnectedOutputKeepsItsData)
{
  Pipeline pipeline;
  pipeline.pruned->Update();
  itk::MedialComplexObject::Pointer kept = pipeline.pruned->GetOutput();
  const auto                        core = kept->GetPart(2).core;
  kept->DisconnectPipeline();
  pipeline.pruned->SetLambda("3vox");
  pipeline.pruned->Update();
  EXPECT_EQ(kept->GetPart(2).core, core);
  EXPECT_NE(pipeline.pruned->GetOutput(), kept.GetPointer());
  EXPECT_EQ(pipeline.pruned->GetOutput()->GetPart(2).core->numbers.lambdaMm, 1.5);
}

TEST(ItkDataObjects, PartsAreSortedFoundAndChecked)
{
  auto                           object = itk::MedialComplexObject::New();
  itk::MedialComplexObject::Part part;
  part.origin.label = 4;
  EXPECT_NE(ThrownBy([&] { object->SetParts({ part }); }).find("label 4 has no core"), std::string::npos);
  part.core = std::make_shared<const CertifiedCore>();
  EXPECT_NE(ThrownBy([&] { object->SetParts({ part, part }); }).find("label 4 is given twice"), std::string::npos);
  auto other = part;
  other.origin.label = 1;
  object->SetParts({ part, other });
  EXPECT_EQ(object->GetParts()[0].origin.label, 1);
  EXPECT_TRUE(object->HasLabel(4));
  EXPECT_NE(ThrownBy([&] { object->GetCore(2); }).find("there is no label 2"), std::string::npos);
}
