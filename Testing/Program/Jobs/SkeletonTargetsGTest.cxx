#include "voxelcore/Jobs/SkeletonTargets.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

using Endings = std::vector<std::string>;

TEST(SkeletonTargets, EndingsAreTakenInTheirOrderEachOnce)
{
  EXPECT_EQ(ParseAlso("csv"), (Endings{ "csv" }));
  EXPECT_EQ(ParseAlso("ma,graphml,mrk.json,swc,csv"), (Endings{ "ma", "graphml", "mrk.json", "swc", "csv" }));
  EXPECT_EQ(ParseAlso("swc,csv,swc"), (Endings{ "swc", "csv" }));
  EXPECT_EQ(ParseAlso("obj,precomputed"), (Endings{ "obj", "precomputed" }));
}

TEST(SkeletonTargets, UnknownOnesAreRefusedWithTheNearest)
{
  for (const char * text : { "", ",", "csv,", "CSV", "csv swc", ".csv", "json", "vtp" })
  {
    EXPECT_THROW(ParseAlso(text), UsageError) << text;
  }
  try
  {
    ParseAlso("csv,graphlm");
    FAIL() << "it was taken";
  }
  catch (const UsageError & error)
  {
    const std::string what = error.what();
    EXPECT_NE(what.find("'graphlm' is not one of csv, swc, mrk.json, graphml, obj, precomputed, ma"), std::string::npos)
      << what;
    EXPECT_NE(what.find("did you mean"), std::string::npos) << what;
  }
}

} // namespace
} // namespace voxelcore::testing
