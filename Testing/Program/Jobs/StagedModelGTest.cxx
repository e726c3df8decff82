#include "JobFolder.h"

#include "voxelcore/Jobs/StagedModel.h"

namespace voxelcore::testing
{
namespace
{

class StagedModel : public JobFolder
{
protected:
  /** Two labels of an isolated vertex and an edge on no face each. */
  static MedialModel
  Model()
  {
    MedialModel model;
    for (const std::int64_t label : { 1, 2 })
    {
      ModelPart       part;
      MedialComplex & core = part.core;
      part.label = label;
      core.cells.vertexCount = 3;
      core.cells.edges = { { 0, 1 } };
      core.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 5, 0, 0 } };
      core.radius = core.vertexLambda = { 1, 1, 1 };
      core.edgeLambda = { 1 };
      model.parts.push_back(part);
    }
    return model;
  }
};

TEST_F(StagedModel, HasItsNameOnlyAfterTheCommit)
{
  WriteModel(At("direct.vtp"), "direct.vtp", Model());
  std::vector<std::string> notes;
  {
    OutputTransaction transaction(false);
    WriteStagedModel(transaction, At("a.vtp"), Model(), {}, notes);
    EXPECT_FALSE(Names().contains("a.vtp"));
    EXPECT_EQ(Names().size(), 2U) << "it waits under another name";
    transaction.Commit();
  }
  EXPECT_EQ(Bytes("a.vtp"), Bytes("direct.vtp"));
  {
    OutputTransaction transaction(false);
    WriteStagedModel(transaction, At("b.vtp"), Model(), {}, notes);
  }
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.vtp", "direct.vtp" })) << "without a commit nothing is left";
  EXPECT_TRUE(notes.empty()) << "a .vtp holds everything";
}

TEST_F(StagedModel, WhatAFormatCannotHoldIsNoted)
{
  std::vector<std::string> notes;
  OutputTransaction        transaction(false);
  MedialModel              model = Model();
  WriteStagedModel(transaction, At("a.ma"), model, { .triangles = true, .keepEdges = false }, notes);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], At("a.ma") + ": what this format cannot hold: 2 labels merged into one (.vtp holds everything)");
  WriteStagedModel(transaction, At("a.stl"), model, { .triangles = true, .keepEdges = false }, notes);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[1].find("2 isolated vertices left out, 2 edges on no face left out, 2 labels merged"),
            std::string::npos)
    << notes[1];
  model.parts[1].label = 1;
  model.parts[0].component = 1;
  model.parts[1].component = 2;
  WriteStagedModel(transaction, At("b.ma"), model, { .triangles = true, .keepEdges = false }, notes);
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_NE(notes[2].find("2 components merged into one"), std::string::npos) << notes[2];
}

TEST_F(StagedModel, WhatCannotBeWrittenLeavesNothing)
{
  std::vector<std::string> notes;
  {
    OutputTransaction transaction(false);
    EXPECT_THROW(WriteStagedModel(transaction, At("a.xyz"), Model(), {}, notes), UsageError);
    EXPECT_THROW(WriteStagedModel(transaction, At("none/a.vtp"), Model(), {}, notes), OutputError);
    MedialModel broken = Model();
    broken.parts[0].core.radius.pop_back();
    EXPECT_THROW(WriteStagedModel(transaction, At("b.vtp"), broken, {}, notes), Error);
  }
  EXPECT_TRUE(Names().empty());
}

} // namespace
} // namespace voxelcore::testing
