#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace voxelcore
{
namespace
{

ParameterValues
CoreValues(const ParameterValues & more)
{
  ParameterValues values{ { "scan", "a.nrrd" }, { "output", "a.vtp" } };
  for (const auto & [name, value] : more)
  {
    values[name] = value;
  }
  return values;
}

/** What a refusal says; empty without one. */
template <typename TCall>
std::string
Refused(const TCall & call)
{
  try
  {
    call();
  }
  catch (const UsageError & error)
  {
    return error.what();
  }
  return "";
}

TEST(Requests, MistypedWordsOfAChoiceSuggestTheNearest)
{
  EXPECT_EQ(Refused([] {
              CoreOptionsFrom(CoreValues({ { "refine", "label" } }));
            }),
            "--refine label: expected one of auto|labels|grey|mesh|off; did you mean 'labels'?");
  EXPECT_EQ(Refused([] {
              CoreOptionsFrom(CoreValues({ { "engine", "latice" } }));
            }),
            "--engine latice: expected one of auto|lattice|tetgen; did you mean 'lattice'?");
  EXPECT_EQ(Refused([] {
              RenderOptionsFrom({ { "files", "a.vtp" }, { "output", "a.png" }, { "view", "frnot" } });
            }),
            "--view frnot: expected one of front|top|iso|auto; did you mean 'front'?");
  EXPECT_EQ(Refused([] { ParseRoot("thikest"); }),
            "--root thikest: expected top, bottom, thickest, or a point in LPS mm such as 12.5,-30,101; did you mean "
            "'thickest'?");
  EXPECT_EQ(Refused([] {
              CoreOptionsFrom(CoreValues({ { "refine", "xyz" } }));
            }),
            "--refine xyz: expected one of auto|labels|grey|mesh|off");
}

// Of what is asked of `core`, which surface it is refined to; empty: none.
TEST(Requests, CoresByToleranceAreRefinedFromLabelsUnlessTheyAreToBePrunedOn)
{
  const std::vector<std::pair<ParameterValues, std::string>> cases{
    { {}, "labels" },
    { { { "tolerance", "2vox" } }, "labels" },
    { { { "tolerance", "1diag,2diag" } }, "labels" },
    { { { "tolerance", "1diag" }, { "lambda", "1vox" } }, "labels" },
    { { { "tolerance", "1diag" }, { "keep-edges", "" } }, "labels" },
    { { { "tolerance", "0" } }, "" },
    { { { "tolerance", "0,1diag" } }, "" },
    { { { "lambda", "0" } }, "" },
    { { { "lambda", "1.5vox,2vox" } }, "" },
    { { { "lambda", "1.5vox" }, { "refine", "labels" } }, "labels" },
    { { { "tolerance", "0" }, { "refine", "labels" } }, "labels" },
    { { { "refine", "off" } }, "" },
    { { { "refine", "auto" } }, "labels" },
    { { { "refine", "grey" } }, "grey" },
    { { { "refine", "mesh" } }, "mesh" },
    { { { "join", "parts/" } }, "labels" },
  };
  for (const auto & [values, surface] : cases)
  {
    const CoreOptions options = CoreOptionsFrom(CoreValues(values));
    EXPECT_EQ(options.refine.surface, surface) << ::testing::PrintToString(values);
    // Beside it a skeleton is the one that `skeleton` gives, unless refinement is asked for.
    auto with = values;
    with.insert({ "with-skeleton", "" });
    const bool asked = values.contains("refine") && values.at("refine") != "auto" && !surface.empty();
    EXPECT_EQ(CoreOptionsFrom(CoreValues(with)).skeleton->refined, asked) << ::testing::PrintToString(values);
  }
  EXPECT_TRUE(InfoOptionsFrom({ { "scan", "a.nrrd" } }).coreRefined);
}

TEST(Requests, BlocksAreExactAndTheirJoinIsRefined)
{
  const auto blocks = [](ParameterValues more) {
    more.insert({ { "blocks", "2" }, { "block", "1" }, { "output", "parts/" } });
    return BlockOptionsFrom(CoreValues(more));
  };
  EXPECT_EQ(blocks({})->core.refine.surface, "");
  EXPECT_EQ(blocks({ { "refine", "off" } })->core.refine.surface, "");
  EXPECT_EQ(Refused([&] {
              blocks({ { "refine", "labels" } });
            }),
            "--refine labels does not work with --block: blocks are exact; give it with --join");
}

TEST(Requests, DefaultsAreThoseOfTheTable)
{
  const CoreOptions options = CoreOptionsFrom(CoreValues({}));
  EXPECT_EQ(options.scan, "a.nrrd");
  ASSERT_EQ(options.lambdas.size(), 1U);
  EXPECT_EQ(options.lambdas[0].text, "0");
  ASSERT_EQ(options.tolerances.size(), 1U);
  EXPECT_EQ(options.tolerances[0].text, kUsualTolerance);
  EXPECT_TRUE(CoreOptionsFrom(CoreValues({ { "lambda", "2vox" } })).tolerances.empty());
  EXPECT_EQ(options.reading.labels, "all");
  EXPECT_FALSE(options.reading.threshold || options.reading.spacing || options.reading.volume || options.report);
  EXPECT_FALSE(options.reading.binary || options.reading.orthonormalize || options.force);
  EXPECT_FALSE(options.model.triangles || options.model.keepEdges);
  EXPECT_EQ(options.threads, 0);
  EXPECT_EQ(options.engine, Engine::Auto);
}

TEST(Requests, ValuesArriveWhereTheyBelong)
{
  const CoreOptions options = CoreOptionsFrom(CoreValues({ { "threshold", "-100.5:inf" },
                                                           { "spacing", "500,250,2000um" },
                                                           { "volume", "3" },
                                                           { "nifti-form", "qform" },
                                                           { "triangles", "true" },
                                                           { "engine", "tetgen" },
                                                           { "threads", "7" },
                                                           { "report", "r.json" } }));
  ASSERT_TRUE(options.reading.threshold && options.reading.spacing && options.reading.volume && options.report);
  EXPECT_EQ(options.reading.threshold->first, -100.5);
  EXPECT_EQ(options.reading.threshold->second, std::numeric_limits<double>::infinity());
  EXPECT_EQ(*options.reading.spacing, (Vector3{ 0.5, 0.25, 2 }));
  EXPECT_EQ(*options.reading.volume, 3);
  EXPECT_EQ(options.reading.niftiForm, "qform");
  EXPECT_TRUE(options.model.triangles);
  EXPECT_EQ(options.engine, Engine::TetGen);
  EXPECT_EQ(options.threads, 7);
  EXPECT_EQ(*options.report, "r.json");
}

TEST(Requests, ValuesWithoutSenseAreUsageErrorsThatNameTheOption)
{
  const std::vector<std::pair<std::string, std::string>> wrong{
    { "threads", "-1" },       { "threads", "two" },     { "threads", "1.5" },     { "threads", "" },
    { "threads", "99999" },    { "spacing", "1,1" },     { "spacing", "1,1,0" },   { "spacing", "1,1,-1" },
    { "spacing", "1,1,inf" },  { "spacing", "1,1,1,1" }, { "spacing", "1;1;1" },   { "threshold", "5" },
    { "threshold", "5:1" },    { "threshold", "a:b" },   { "threshold", "1:2:3" }, { "threshold", "nan:2" },
    { "nifti-form", "rform" }, { "volume", "-1" },       { "engine", "cgal" },     { "engine", "auto|tetgen" },
    { "labels", "" },          { "lambda", "3apples" },  { "lambda", "-2mm" },     { "output", "" },
    { "report", "" },          { "min-voxels", "0" },    { "min-voxels", "-3" },   { "min-voxels", "1.5" },
    { "largest", "0" },        { "largest", "all" },     { "crop", "" },           { "crop", "0:5" },
    { "crop", "0:5,0:5" },     { "crop", "5:5,:,:" },    { "crop", "5:4,:,:" },    { "crop", "-1:4,:,:" },
    { "crop", "0:0,:,:" },     { "crop", ":0,:,:" },     { "crop", ":,:,:,:" },    { "crop", "0-5,:,:" },
    { "crop", "0:5:2,:,:" },   { "crop", "a:b,:,:" },    { "crop", "0:5,,0:5" },   { "crop", "0:99999999999,:,:" },
    { "crop", "0:1.5,:,:" },   { "crop", " 0:1,:,:" },   { "threshold", "1:nan" }, { "threshold", "1:1e400" },
    { "threshold", "+-1:5" },
  };
  for (const auto & [name, value] : wrong)
  {
    try
    {
      CoreOptionsFrom(CoreValues({ { name, value } }));
      ADD_FAILURE() << "--" << name << " " << value << " was accepted";
    }
    catch (const UsageError & error)
    {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(name == "lambda" ? value : name), std::string::npos) << error.what();
    }
  }
}

TEST(Requests, ACropIsReadAsRangesWithOpenEnds)
{
  const auto crop = ParseCrop("3:10,:7,:");
  EXPECT_EQ(crop.first, (std::array<std::int32_t, 3>{ 3, 0, 0 }));
  EXPECT_EQ(crop.end, (std::array<std::int32_t, 3>{ 10, 7, 0 })) << "0: to the scan's end";
  EXPECT_EQ(ParseCrop("5:,0:1,2147483646:2147483647").first, (std::array<std::int32_t, 3>{ 5, 0, 2147483646 }));
}

TEST(Requests, EditsArriveWhereTheyBelong)
{
  EXPECT_FALSE(CoreOptionsFrom(CoreValues({})).edits.AreAsked());
  const ParameterValues  given{ { "min-voxels", "20" },   { "largest", "2" },         { "fill-cavities", "true" },
                               { "mend-shape", "true" }, { "smooth-shape", "true" }, { "split-components", "true" } };
  const ShapeEditOptions core = CoreOptionsFrom(CoreValues(given)).edits;
  const ShapeEditOptions info = InfoOptionsFrom(CoreValues(given)).edits;
  for (const ShapeEditOptions & edits : { core, info })
  {
    ASSERT_TRUE(edits.minVoxels && edits.largest);
    EXPECT_EQ(*edits.minVoxels, 20U);
    EXPECT_EQ(*edits.largest, 2U);
    EXPECT_TRUE(edits.fillCavities && edits.splitComponents && edits.mend && edits.smooth);
  }
}

TEST(Requests, NumbersOfATopologyNeedTheDepthOfItsChanges)
{
  const ShapeEditOptions edits =
    CoreOptionsFrom(CoreValues({ { "simplify-topology", "2vox" }, { "pieces", "1" }, { "cavities", "0" } })).edits;
  EXPECT_EQ(edits.simplify->text, "2vox");
  EXPECT_EQ(edits.topology.pieces, 1);
  EXPECT_FALSE(edits.topology.loops);
  EXPECT_EQ(edits.topology.cavities, 0);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "pieces", "1" } })), UsageError);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "simplify-topology", "2vox" }, { "loops", "-1" } })), UsageError);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "simplify-topology", "0" } })), UsageError);
}

TEST(Requests, ATreeIsOnePieceWithoutLoopsAndCavities)
{
  const ShapeEditOptions edits = CoreOptionsFrom(CoreValues({ { "tree", "true" } })).edits;
  EXPECT_EQ(edits.simplify->text, "3vox");
  EXPECT_EQ(edits.topology.pieces, 1);
  EXPECT_EQ(edits.topology.loops, 0);
  EXPECT_EQ(edits.topology.cavities, 0);
  EXPECT_EQ(edits.connectivity, Connectivity::Six) << "what touches is joined where pieces would fall apart alone";
  const auto byCorners = CoreOptionsFrom(CoreValues({ { "tree", "true" }, { "connectivity", "26" } })).edits;
  EXPECT_EQ(byCorners.connectivity, Connectivity::TwentySix);
  const auto deeper = CoreOptionsFrom(CoreValues({ { "tree", "true" }, { "simplify-topology", "5vox" } })).edits;
  EXPECT_EQ(deeper.simplify->text, "5vox");
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "tree", "true" }, { "loops", "1" } })), UsageError);
}

TEST(Requests, AMaskIsReadByFacesUnlessCornersAreAskedFor)
{
  EXPECT_EQ(CoreOptionsFrom(CoreValues({})).edits.connectivity, Connectivity::Six);
  EXPECT_EQ(CoreOptionsFrom(CoreValues({ { "connectivity", "26" } })).edits.connectivity, Connectivity::TwentySix);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "connectivity", "18" } })), UsageError);
}

TEST(Requests, SkeletonsJoinPiecesThatTouchUnlessSimplificationDoes)
{
  const auto read = [](ParameterValues values) {
    values["scan"] = "a.nrrd";
    values["output"] = "s.vtp";
    return SkeletonOptionsFrom(values).edits.connectivity;
  };
  EXPECT_EQ(read({}), Connectivity::Joined);
  EXPECT_EQ(read({ { "connectivity", "6" } }), Connectivity::Six);
  EXPECT_EQ(read({ { "tree", "true" } }), Connectivity::Six);
  EXPECT_EQ(read({ { "simplify-topology", "2vox" }, { "loops", "0" } }), Connectivity::Joined);
  EXPECT_EQ(read({ { "tree", "true" }, { "connectivity", "joined" } }), Connectivity::Joined);
}

TEST(Requests, WhatToReadArrivesWhereItBelongs)
{
  const ParameterValues given{ { "crop", "1:2,3:4,5:6" }, { "component", "2" }, { "volume", "3" } };
  for (const ReadOptions & reading : { CoreOptionsFrom(CoreValues(given)).reading, InfoOptionsFrom(given).reading })
  {
    ASSERT_TRUE(reading.crop && reading.component && reading.volume);
    EXPECT_EQ(reading.crop->end, (std::array<std::int32_t, 3>{ 2, 4, 6 }));
    EXPECT_EQ(*reading.component, 2);
    EXPECT_EQ(*reading.volume, 3);
  }
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "component", "-1" } })), UsageError);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "crop", "1:2" } })), UsageError);
}

TEST(Requests, WaysToChooseVoxelsExcludeEachOther)
{
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "binary", "true" }, { "labels", "3" } })), UsageError);
  EXPECT_THROW(CoreOptionsFrom(CoreValues({ { "binary", "true" }, { "threshold", "1:2" } })), UsageError);
}

TEST(Requests, PhantomSizesMayBeOneOrThree)
{
  const ParameterValues one{ { "kind", "ball" }, { "output", "a.nrrd" }, { "size", "12" } };
  const ParameterValues three{ { "kind", "ball" }, { "output", "a.nrrd" }, { "size", "12,13,14" } };
  const ParameterValues none{ { "kind", "ball" }, { "output", "a.nrrd" }, { "size", "0" } };
  EXPECT_EQ(PhantomOptionsFrom(one).phantom.size[2], 12);
  EXPECT_EQ(PhantomOptionsFrom(three).phantom.size[1], 13);
  EXPECT_THROW(PhantomOptionsFrom(none), UsageError);
}

} // namespace
} // namespace voxelcore
