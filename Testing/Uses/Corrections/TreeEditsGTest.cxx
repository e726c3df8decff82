#include "voxelcore/Corrections/TreeEdits.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <random>

namespace voxelcore::testing
{
namespace
{

/** A trunk along x and a branch off it along y, in voxels of 0.5 mm, and their tree. */
class TreeEdits : public ::testing::Test
{
protected:
  TreeEdits()
    : m_Shape(ShapeWhere({ 70, 60, 24 }, [](int x, int y, int z) {
      const bool trunk = std::hypot(y - 12.0, z - 12.0) < 4.5 && x >= 4 && x < 66;
      const bool branch = std::hypot(x - 35.0, z - 12.0) < 3.5 && y >= 12 && y < 44;
      return trunk || branch;
    }))
  {
    m_Geometry.size = { 70, 60, 24 };
    m_Geometry.spacing = { 0.5, 0.5, 0.5 };
    m_Tree = TreeOf(m_Shape);
  }

  MeasuredSkeleton
  TreeOf(const VoxelShape & shape) const
  {
    CertifiedRequest request;
    request.lambdas = { ParseLambda("0") };
    request.surface = SurfaceSource();
    request.skeleton.emplace();
    request.skeleton->lambda = ParseLambda("0");
    request.skeleton->standOut = ParseLambda("3vox");
    request.skeleton->smooth = ParseLambda("6vox");
    request.skeleton->branches.pruneRadii = 1;
    return ComputeCertified(shape, m_Geometry, request).skeleton->skeleton;
  }
  /** Of a voxel. */
  static Vector3
  At(double i, double j, double k)
  {
    return { 0.5 * i, 0.5 * j, 0.5 * k };
  }
  EditedTree
  Edit(const std::vector<TreeEdit> & edits) const
  {
    return EditTree(m_Shape, m_Geometry, m_Tree, edits);
  }
  void
  ExpectMisfit(const TreeEdit & edit, const std::string & why) const
  {
    const EditedTree edited = Edit({ edit });
    EXPECT_EQ(edited.outcomes.at(0).misfit, why);
    EXPECT_TRUE(edited.outcomes.at(0).voxels.empty());
    EXPECT_EQ(edited.shape.CountVoxels(), m_Shape.CountVoxels());
  }
  static std::vector<std::string>
  MisfitsOf(const EditedTree & edited)
  {
    std::vector<std::string> misfits;
    std::transform(edited.outcomes.begin(), edited.outcomes.end(), std::back_inserter(misfits), [](const auto & one) {
      return one.misfit;
    });
    return misfits;
  }
  static std::array<std::int64_t, 3>
  BettiOf(const VoxelShape & shape)
  {
    return ComputeShapeTopology(shape).betti;
  }

  VoxelShape       m_Shape;
  ImageGeometry    m_Geometry;
  MeasuredSkeleton m_Tree;
};

using Kind = TreeEdit::Kind;
using Betti = std::array<std::int64_t, 3>;

TEST_F(TreeEdits, ACutPartsTheBodyAndAJoinMendsIt)
{
  ASSERT_EQ(m_Tree.graph.BranchCount(), 3U);
  const EditedTree cut = Edit({ { Kind::Cut, At(35, 30, 12) } });
  EXPECT_EQ(cut.outcomes.at(0).misfit, "");
  EXPECT_EQ(cut.outcomes.at(0).change, (Betti{ 1, 0, 0 }));
  EXPECT_EQ(BettiOf(cut.shape), (Betti{ 2, 0, 0 }));
  EXPECT_EQ(CountComponents26(cut.shape), 2);
  EXPECT_LT(cut.shape.CountVoxels(), m_Shape.CountVoxels());
  EXPECT_GT(cut.shape.CountVoxels(), m_Shape.CountVoxels() - 100); // a slab of it
  const MeasuredSkeleton apart = TreeOf(cut.shape);
  const EditedTree       joined =
    EditTree(cut.shape, m_Geometry, apart, std::vector<TreeEdit>{ { Kind::Join, At(35, 28, 12), { At(35, 32, 12) } } });
  EXPECT_EQ(joined.outcomes.at(0).misfit, "");
  EXPECT_EQ(BettiOf(joined.shape), (Betti{ 1, 0, 0 }));
  EXPECT_EQ(TreeOf(joined.shape).graph.BranchCount(), 3U);
}

TEST_F(TreeEdits, ABranchGoesWithWhatSpringsFromItAndNothingElse)
{
  const EditedTree removed = Edit({ { Kind::Remove, At(35, 35, 12) } });
  EXPECT_EQ(removed.outcomes.at(0).misfit, "");
  EXPECT_EQ(BettiOf(removed.shape), (Betti{ 1, 0, 0 }));
  EXPECT_EQ(TreeOf(removed.shape).graph.BranchCount(), 1U);
  for (int y = 22; y < 44; ++y)
  {
    EXPECT_FALSE(removed.shape.Contains(35, y, 12)) << y;
  }
  EXPECT_TRUE(removed.shape.Contains(35, 12, 12));
  EXPECT_TRUE(removed.shape.Contains(60, 12, 12));
  // What springs from what is said by the root: from the branch's tip the half of the trunk is a branch.
  const EditedTree other = Edit({ { Kind::Remove, At(50, 12, 12) }, { Kind::Root, At(35, 44, 12) } });
  EXPECT_EQ(MisfitsOf(other), (std::vector<std::string>{ "", "" }));
  EXPECT_FALSE(other.shape.Contains(60, 12, 12));
  EXPECT_TRUE(other.shape.Contains(10, 12, 12));
  EXPECT_TRUE(other.shape.Contains(35, 40, 12));
}

TEST_F(TreeEdits, APathIsABranchAsThickAsThatWhichItLeavesOrAsSaid)
{
  const EditedTree path = Edit({ { Kind::Path, At(35, 28, 12), { At(50, 40, 12), At(60, 50, 12) } } });
  EXPECT_EQ(path.outcomes.at(0).misfit, "");
  EXPECT_EQ(BettiOf(path.shape), (Betti{ 1, 0, 0 }));
  EXPECT_TRUE(path.shape.Contains(50, 40, 12));
  EXPECT_TRUE(path.shape.Contains(50, 42, 12));
  EXPECT_FALSE(path.shape.Contains(50, 46, 12));
  EXPECT_EQ(TreeOf(path.shape).graph.BranchCount(), 5U);
  const EditedTree thin = Edit({ { Kind::Path, At(35, 28, 12), { At(50, 40, 12), At(60, 50, 12) }, 0.5 } });
  EXPECT_EQ(thin.outcomes.at(0).misfit, "");
  EXPECT_TRUE(thin.shape.Contains(50, 40, 12));
  EXPECT_FALSE(thin.shape.Contains(50, 42, 12));
  // Back to the body it closes a loop.
  const EditedTree loop = Edit({ { Kind::Path, At(35, 38, 12), { At(55, 36, 12), At(55, 12, 12) } } });
  EXPECT_EQ(loop.outcomes.at(0).misfit, "");
  EXPECT_EQ(BettiOf(loop.shape), (Betti{ 1, 1, 0 }));
}

TEST_F(TreeEdits, OtherEditsNameATipOrAVoxelOrABranch)
{
  const EditedTree root =
    Edit({ { Kind::Root, At(35, 44, 12) }, { Kind::Background, At(10, 16, 12) }, { Kind::None, At(10, 12, 12) } });
  EXPECT_EQ(MisfitsOf(root), (std::vector<std::string>(3)));
  ASSERT_TRUE(root.root.has_value());
  EXPECT_LT(Distance(*root.root, At(35, 43.5, 12)), 1.5);
  EXPECT_TRUE(m_Shape.Contains(10, 16, 12));
  EXPECT_FALSE(root.shape.Contains(10, 16, 12));
  EXPECT_EQ(root.shape.CountVoxels(), m_Shape.CountVoxels() - 1);
}

TEST_F(TreeEdits, ALoopIsRealWhereOnePassesAndACutOpensIt)
{
  const VoxelShape       ring = ShapeWhere({ 60, 60, 24 }, [](int x, int y, int z) {
    const double around = std::hypot(x - 30.0, y - 30.0) - 18;
    return std::hypot(around, z - 12.0) < 4.5 || (std::hypot(y - 30.0, z - 12.0) < 3.5 && x >= 46 && x < 58);
  });
  const MeasuredSkeleton tree = TreeOf(ring);
  const auto             edit = [&](const TreeEdit & one) {
    return EditTree(ring, m_Geometry, tree, std::vector<TreeEdit>{ one });
  };
  const EditedTree real = edit({ Kind::Loop, At(12, 30, 12) });
  EXPECT_EQ(real.outcomes.at(0).misfit, "");
  ASSERT_EQ(real.loops.size(), 1U);
  SkeletonGraph kept = tree.graph;
  EXPECT_TRUE(CutLoops(kept, real.loops).empty());
  EXPECT_EQ(edit({ Kind::Loop, At(56, 30, 12) }).outcomes.at(0).misfit, "no loop passes there");
  const EditedTree cut = edit({ Kind::Cut, At(12, 30, 12) });
  EXPECT_EQ(cut.outcomes.at(0).misfit, "");
  EXPECT_EQ(cut.outcomes.at(0).change, (Betti{ 0, -1, 0 }));
  EXPECT_EQ(BettiOf(cut.shape), (Betti{ 1, 0, 0 }));
  // The rest hangs together round the other side.
  const EditedTree none = edit({ Kind::Remove, At(30, 12, 12) });
  EXPECT_NE(none.outcomes.at(0).misfit, "");
  EXPECT_EQ(none.shape.CountVoxels(), ring.CountVoxels());
}

TEST_F(TreeEdits, WhatDoesNotFitChangesNothing)
{
  ExpectMisfit({ Kind::Cut, At(60, 40, 12) }, "no branch passes there");
  ExpectMisfit({ Kind::None, At(60, 40, 12) }, "no branch passes there");
  ExpectMisfit({ Kind::Remove, At(60, 40, 12) }, "no branch passes there");
  ExpectMisfit({ Kind::Loop, At(60, 40, 12) }, "no branch passes there");
  ExpectMisfit({ Kind::Loop, At(35, 30, 12) }, "no loop passes there");
  ExpectMisfit({ Kind::Path, At(60, 40, 12), { At(1, 1, 1) } }, "no branch passes there");
  ExpectMisfit({ Kind::Join, At(35, 44, 12), { At(35, 30, 12) } }, "no tip is there");
  ExpectMisfit({ Kind::Join, At(35, 44, 12), { At(35, 43, 12) } }, "both places are at one tip");
  ExpectMisfit({ Kind::Path, At(20, 12, 12), { At(25, 12, 12) } }, "all of its way is in the body already");
  ExpectMisfit({ Kind::Path, At(20, 12, 12), { At(1e9, 12, -1e300) } }, "it leaves the scan");
  ExpectMisfit({ Kind::Path, At(20, 12, 12), { At(20, 12, 60) } }, "it leaves the scan");
  ExpectMisfit({ Kind::Path, At(20, 12, 12), { At(20, 40, 12) }, 1e9 }, "it would be thicker than the whole tree");
  ExpectMisfit({ Kind::Root, At(35, 25, 12) }, "no tip is there");
  ExpectMisfit({ Kind::Background, At(1, 1, 1) }, "the voxel there is none of the body");
  ExpectMisfit({ Kind::Background, At(-500, 1, 1e9) }, "the voxel there is none of the body");
  ExpectMisfit({ Kind::Background, At(20, 12, 12) }, "it would be a cavity; name voxels from the surface on inwards");
  ExpectMisfit({ Kind::Remove, At(20, 12, 12) }, "nothing would be left");
  // What was done before counts.
  EXPECT_EQ(MisfitsOf(Edit({ { Kind::Cut, At(35, 30, 12) }, { Kind::Cut, At(35, 30, 12) } })).at(1),
            "an edit before it has taken that off");
  EXPECT_EQ(MisfitsOf(Edit({ { Kind::Root, At(35, 44, 12) }, { Kind::Root, At(4, 12, 12) } })).at(1),
            "the hierarchy begins at another place already");
}

// The branch is removed whole, its twig or half of it are not left behind, whichever is said first.
TEST_F(TreeEdits, WhatIsDoneDoesNotDependOnTheOrderOfEdits)
{
  std::vector<TreeEdit> edits{ { Kind::Remove, At(35, 35, 12) },
                               { Kind::Cut, At(50, 12, 12) },
                               { Kind::Cut, At(35, 30, 12) },
                               { Kind::Path, At(20, 12, 12), { At(20, 40, 12) }, 1.0 } };
  const EditedTree      expected = Edit(edits);
  EXPECT_EQ(MisfitsOf(expected), (std::vector<std::string>(4)));
  std::sort(edits.begin(), edits.end(), [](const TreeEdit & a, const TreeEdit & b) { return a.place < b.place; });
  do
  {
    const EditedTree edited = Edit(edits);
    EXPECT_EQ(MisfitsOf(edited), (std::vector<std::string>(4)));
    EXPECT_EQ(edited.shape.CountVoxels(), expected.shape.CountVoxels());
    EXPECT_EQ(BettiOf(edited.shape), BettiOf(expected.shape));
    EXPECT_NO_THROW(RequireEdits(m_Shape,
                                 ComputeShapeTopology(m_Shape),
                                 edits,
                                 edited,
                                 ComputeShapeTopology(edited.shape),
                                 "a body"));
  } while (std::next_permutation(edits.begin(), edits.end(), [](const TreeEdit & a, const TreeEdit & b) {
    return a.place < b.place;
  }));
}

TEST_F(TreeEdits, AnEndThatHasRecededIsJoinedThroughThePlaceWhereItWas)
{
  // A bar apart from the trunk; the twig that led towards it is gone.
  const VoxelShape       apart = ShapeWhere({ 70, 60, 24 }, [&](int x, int y, int z) {
    return m_Shape.Contains(x, y, z) || (std::hypot(x - 20.0, z - 12.0) < 3.5 && y >= 34 && y < 56);
  });
  const MeasuredSkeleton tree = TreeOf(apart);
  const auto             join = [&](const Vector3 & from) {
    return EditTree(apart, m_Geometry, tree, std::vector<TreeEdit>{ { Kind::Join, from, { At(20, 34, 12) } } });
  };
  const EditedTree joined = join(At(20, 22, 12)); // ten voxels off the trunk's line, twelve off the bar
  EXPECT_EQ(joined.outcomes.at(0).misfit, "");
  EXPECT_EQ(BettiOf(joined.shape), (Betti{ 1, 0, 0 }));
  EXPECT_EQ(joined.outcomes.at(0).change, (Betti{ -1, 0, 0 }));
  EXPECT_EQ(join(At(20, 31, 12)).outcomes.at(0).misfit, "both places are at one tip");
  EXPECT_EQ(join(At(20, 12, 12)).outcomes.at(0).misfit, "no tip is there"); // a branch passes there
  EXPECT_EQ(join(At(60, 50, 12)).outcomes.at(0).misfit, ""); // the branch's tip is nearer than the gap is long
}

TEST_F(TreeEdits, ACheckRefusesABodyOrATreeThatIsNotThatOfTheEdits)
{
  const std::vector<TreeEdit> edits{ { Kind::Cut, At(35, 30, 12) },
                                     { Kind::Path, At(20, 12, 12), { At(20, 40, 12) }, 1.0 },
                                     { Kind::Cut, At(60, 40, 12) } };
  const EditedTree            edited = Edit(edits);
  EXPECT_EQ(MisfitsOf(edited), (std::vector<std::string>{ "", "", "no branch passes there" }));
  const TopologyNumbers before = ComputeShapeTopology(m_Shape);
  const TopologyNumbers after = ComputeShapeTopology(edited.shape);
  const auto            refuses = [&](const EditedTree & seeded, const TopologyNumbers & certified) {
    try
    {
      RequireEdits(m_Shape, before, edits, seeded, certified, "a body");
    }
    catch (const CertificateError & error)
    {
      return std::string(error.what()).starts_with("a body: ");
    }
    return false;
  };
  EXPECT_FALSE(refuses(edited, after));
  EXPECT_TRUE(refuses(edited, before));
  EditedTree seeded = edited;
  seeded.shape.Insert(35, 12, 12); // is in
  EXPECT_FALSE(refuses(seeded, after));
  seeded.outcomes[0].voxels.pop_back();
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.outcomes[1].voxels.push_back(seeded.outcomes[1].voxels.front());
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.outcomes[0].change = { 0, 1, 0 };
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.outcomes[2].voxels.push_back({ 4, 12, 12 });
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.shape = m_Shape;
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.order = { 0, 1, 1 };
  EXPECT_TRUE(refuses(seeded, after));
  seeded.order = { 0, 1, 3 };
  EXPECT_TRUE(refuses(seeded, after));
  seeded = edited;
  seeded.outcomes.pop_back();
  EXPECT_TRUE(refuses(seeded, after));
}

// Trees of five straight tubes, and edits at random places of them: each does what it says or nothing at all.
TEST_F(TreeEdits, OfRandomTreesRandomEditsAreDoneAsDefinedOrChangeNothing)
{
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const auto   real = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  std::size_t  done = 0;
  for (int run = 0; run < 6; ++run)
  {
    std::vector<std::pair<Vector3, Vector3>> tubes{ { { 6, 24, 24 }, { 44, 24, 24 } } };
    while (tubes.size() < 5)
    {
      const auto & [from, to] = tubes[tubes.size() / 2];
      const double share = real(0.2, 0.9);
      tubes.push_back({ AddScaled(from, share, Minus(to, from)), { real(5, 43), real(5, 43), real(5, 43) } });
    }
    const VoxelShape shape =
      KeepLargestComponents(ShapeWhere({ 50, 50, 50 },
                                       [&](int x, int y, int z) {
                                         const Vector3 here{ x + 0.5, y + 0.5, z + 0.5 };
                                         return ranges::any_of(tubes, [&](const auto & tube) {
                                           const Vector3 way = Minus(tube.second, tube.first);
                                           const Vector3 from = Minus(here, tube.first);
                                           const double  share = std::clamp(Dot(from, way) / Dot(way, way), 0.0, 1.0);
                                           return Length(AddScaled(from, -share, way)) < 2.6;
                                         });
                                       }),
                            1)
        .shape;
    m_Geometry.size = { 50, 50, 50 };
    const MeasuredSkeleton tree = TreeOf(FillCavities(shape).shape);
    const VoxelShape       body = FillCavities(shape).shape;
    std::vector<TreeEdit>  edits;
    for (const Kind kind : { Kind::Path, Kind::Cut, Kind::Background, Kind::Remove, Kind::Join, Kind::Loop, Kind::Cut })
    {
      const auto & place = tree.graph.positions[random() % tree.graph.positions.size()];
      const auto & other = tree.graph.positions[tree.graph.nodePoints[random() % tree.graph.nodePoints.size()]];
      edits.push_back({ kind, place });
      if (kind == Kind::Path)
      {
        edits.back().further = { At(real(1, 49), real(1, 49), real(1, 49)) };
      }
      if (kind == Kind::Join)
      {
        edits.back().place = tree.graph.positions[tree.graph.nodePoints[0]];
        edits.back().further = { other };
      }
    }
    const EditedTree edited = EditTree(body, m_Geometry, tree, edits);
    for (const auto & outcome : edited.outcomes)
    {
      done += outcome.misfit.empty() ? 1 : 0;
    }
    EXPECT_NO_THROW(RequireEdits(body,
                                 ComputeShapeTopology(body),
                                 edits,
                                 edited,
                                 ComputeShapeTopology(edited.shape),
                                 std::to_string(run)));
    const EditedTree again = EditTree(body, m_Geometry, tree, edits);
    EXPECT_EQ(MisfitsOf(again), MisfitsOf(edited));
    EXPECT_EQ(again.shape.CountVoxels(), edited.shape.CountVoxels());
  }
  EXPECT_GE(done, 6U);
}

TEST_F(TreeEdits, TextsAreReadBack)
{
  for (const char * text : { "cut",
                             "remove",
                             "join 1 2.5 -3",
                             "path 1 2 3; 4 5 6.25",
                             "path 1 2 3 radius 0.5",
                             "root",
                             "loop",
                             "background",
                             "" })
  {
    EXPECT_EQ(TreeEditText(ParseTreeEdit(text)), text);
  }
  EXPECT_EQ(TreeEditText(ParseTreeEdit("  path 1  2 3 ;4 5 6 \r")), "path 1 2 3; 4 5 6");
  for (const char * text : { "cute",
                             "cut 1 2 3",
                             "join",
                             "join 1 2",
                             "join 1 2 3; 4 5 6",
                             "join 1 2 3 radius 4",
                             "path",
                             "path radius 1",
                             "path 1 2 x",
                             "path 1 2 3; 4",
                             "path 1 2 3;",
                             "path 1 2 3 radius",
                             "path 1 2 3 radius 0",
                             "path 1 2 3 radius -1",
                             "path 1 2 3 radius inf",
                             "path 1 2 inf",
                             "path 1 2 nan" })
  {
    EXPECT_THROW(ParseTreeEdit(text), UsageError) << text;
  }
  std::string most = "path 0 0 0";
  for (int i = 1; i < 1000; ++i)
  {
    most += "; 0 0 0";
  }
  EXPECT_EQ(ParseTreeEdit(most).further.size(), 1000U);
  EXPECT_THROW(ParseTreeEdit(most + "; 0 0 0"), UsageError);
}

} // namespace
} // namespace voxelcore::testing
