// Pruning, refinement, skeletons, kept edges, several values, blocks and pruning on, in every way they go together:
// what comes out passes `verify`, and what makes no sense is refused in one line.

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Options/Requests.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace voxelcore::testing
{
namespace
{


class Combinations : public ::testing::Test
{
protected:
  Combinations()
  {
    RunPhantomJob(PhantomOptionsFrom(
      { { "kind", "capsule" }, { "size", "18" }, { "radius", "3.4" }, { "output", At("scan.nrrd") } }));
    std::ofstream mesh(m_Folder / "mesh.off");
    mesh << "OFF\n6 8 0\n9 0 0\n-9 0 0\n0 6 0\n0 -6 0\n0 0 5\n0 0 -5\n";
    for (const char * face : { "0 2 4", "2 1 4", "1 3 4", "3 0 4", "2 0 5", "1 2 5", "3 1 5", "0 3 5" })
    {
      mesh << "3 " << face << "\n";
    }
  }

  std::string
  At(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  /** What a surface is estimated from, and how it is read. */
  ParameterValues
  InputFor(const std::string & refine) const
  {
    if (refine == "mesh")
    {
      return { { "scan", At("mesh.off") }, { "resolution", "14" } };
    }
    ParameterValues values{ { "scan", At("scan.nrrd") } };
    if (refine == "grey")
    {
      values["threshold"] = "0.5:inf";
    }
    return values;
  }

  /** The medial surfaces that were written. */
  std::vector<std::string>
  Run(ParameterValues values, const ParameterValues & more)
  {
    values.insert(more.begin(), more.end());
    values["output"] = At(std::to_string(++m_Runs) + ".vtp");
    const CoreResult         result = RunCoreJob(CoreOptionsFrom(values));
    std::vector<std::string> files;
    for (const PrunedRecord & one : result.report.labels.at(0).pruned)
    {
      files.push_back(one.output);
    }
    return files;
  }

  std::string
  Prune(const std::string & file, const ParameterValues & how)
  {
    ParameterValues values = how;
    values["core"] = file;
    values["output"] = At(std::to_string(++m_Runs) + ".vtp");
    RunPruneJob(PruneOptionsFrom(values));
    return values["output"];
  }

  static void
  ExpectVerified(const std::string & scan, const std::string & file, const std::string & refined)
  {
    EXPECT_EQ(ReadModel(file).refined, refined);
    const VerifyResult result = RunVerifyJob({ scan, file });
    EXPECT_TRUE(result.passed) << VerifyText(result);
  }

  static std::string
  BytesOf(const std::string & file)
  {
    std::ifstream      in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }

  TemporaryFolder m_Folder;
  int             m_Runs = 0;
};

const std::vector<ParameterValues> kPrunings{ {},
                                              { { "tolerance", "1diag,2diag" } },
                                              { { "tolerance", "0" } },
                                              { { "tolerance", "1diag" }, { "lambda", "1vox" } },
                                              { { "lambda", "1.5vox" } },
                                              { { "lambda", "0,2vox" } } };

TEST_F(Combinations, OfPruningRefinementSkeletonsAndKeptEdgesPassVerifyAndArePrunedOn)
{
  for (const ParameterValues & pruning : kPrunings)
  {
    for (const std::string refine : { "", "off", "labels", "grey", "mesh" })
    {
      for (const std::string extra : { "", "with-skeleton", "keep-edges" })
      {
        ParameterValues values = pruning;
        if (!refine.empty())
        {
          values["refine"] = refine;
        }
        if (!extra.empty())
        {
          values[extra] = "true";
        }
        if (extra == "with-skeleton" && (refine == "off" || refine == "mesh"))
        {
          continue; // for time
        }
        SCOPED_TRACE(::testing::PrintToString(values));
        const ParameterValues input = InputFor(refine);
        const bool            byTolerance = pruning.empty() || pruning.contains("tolerance");
        const bool            whole = byTolerance && !pruning.empty() && pruning.at("tolerance") == "0";
        const std::string     refined = !refine.empty()         ? (refine == "off" ? "" : refine)
                                        : byTolerance && !whole ? "labels"
                                                                : "";
        for (const std::string & file : Run(input, values))
        {
          const std::string & scan = input.at("scan");
          ExpectVerified(scan, file, refined);
          if (byTolerance)
          {
            ExpectVerified(scan, Prune(file, { { "tolerance", "3diag" } }), refined);
            const ParameterValues other{ { "lambda", "3vox" } };
            if (!whole)
            {
              EXPECT_THROW(Prune(file, other), InputError) << "by tolerance already";
            }
          }
          else
          {
            const ParameterValues other{ { "lambda", "3vox" } };
            EXPECT_THROW(Prune(file, { { "tolerance", "3diag" } }), InputError) << "it holds no tolerances";
            if (extra == "keep-edges") // pruned ones cannot be pruned on without; whole ones can
            {
              ExpectVerified(scan, Prune(file, other), refined);
            }
          }
        }
      }
    }
  }
}

TEST_F(Combinations, BlocksJoinToTheBytesOfASingleRunHoweverItIsPrunedAndRefined)
{
  for (const char * block : { "1", "2" })
  {
    const auto options = BlockOptionsFrom(
      { { "scan", At("scan.nrrd") }, { "blocks", "2" }, { "block", block }, { "output", At("parts/") } });
    RunBlockJob(*options);
  }
  for (const ParameterValues & pruning : kPrunings)
  {
    for (const std::string refine : { "auto", "off", "labels" })
    {
      ParameterValues values = pruning;
      values["refine"] = refine;
      SCOPED_TRACE(::testing::PrintToString(values));
      const auto single = Run(InputFor(refine), values);
      values["join"] = At("parts/");
      const auto joined = Run(InputFor(refine), values);
      ASSERT_EQ(single.size(), joined.size());
      for (std::size_t i = 0; i < single.size(); ++i)
      {
        EXPECT_EQ(BytesOf(single[i]), BytesOf(joined[i]));
      }
    }
  }
}

TEST_F(Combinations, AreShownInScenesAndWrittenBesideSkeletons)
{
  for (const std::string refine : { "auto", "off" })
  {
    Run(InputFor(refine), { { "refine", refine }, { "scene", At(refine + ".mrml") }, { "with-skeleton", "true" } });
    ParameterValues of{ { "scan", At(std::to_string(m_Runs) + ".vtp") }, { "output", At(refine + "_of.vtp") } };
    of["also"] = "ma";
    RunSkeletonJob(SkeletonOptionsFrom(of));
    EXPECT_TRUE(std::filesystem::exists(m_Folder / (refine + "_of.vtp")));
  }
}

TEST_F(Combinations, WithoutSenseAreRefusedInOneLine)
{
  const std::vector<std::pair<ParameterValues, std::string>> cases{
    { { { "tolerance", "1diag" }, { "lambda", "1vox,2vox" } }, "--lambda" },
    { { { "refine", "mesh" } }, "is no mesh" },
    { { { "refine", "grey" } }, "--refine grey needs grey values" },
    { { { "refine", "grey" }, { "threshold", "-inf:inf" } }, "has no end" },
    { { { "grey", "other.nrrd" }, { "grey-range", "1:2" } }, "--grey needs --refine grey" },
    { { { "refine", "labels" }, { "grey", "other.nrrd" }, { "grey-range", "1:2" } }, "--grey needs --refine grey" },
    { { { "refine", "grey" }, { "grey", "other.nrrd" } }, "--grey SCAN and --grey-range LO:HI together" },
    { { { "refine", "both" } }, "expected one of auto|labels|grey|mesh|off" },
  };
  for (const auto & [values, message] : cases)
  {
    SCOPED_TRACE(::testing::PrintToString(values));
    try
    {
      Run(InputFor(""), values);
      ADD_FAILURE() << "went through";
    }
    catch (const UsageError & error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find(message), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
