#include "JobFolder.h"

#include "voxelcore/Jobs/SkeletonFiles.h"

#include <bit>
#include <cstdint>

namespace voxelcore::testing
{
namespace
{

/** Two labels with a straight branch each, and what a report says of them. */
class SkeletonFilesOfJobs : public JobFolder
{
protected:
  SkeletonFilesOfJobs()
  {
    m_Report.parameters.lambda = { "0" };
    m_Report.skeleton.emplace();
    for (const std::int64_t value : { 2, 5 })
    {
      LabelRecord record;
      record.label = value;
      record.name = "n" + std::to_string(value);
      record.skeleton.emplace();
      m_Report.labels.push_back(record);
    }
  }

  SkeletonPart
  Part(std::size_t label) const
  {
    SkeletonPart part;
    part.label = m_Report.labels[label].label;
    part.name = m_Report.labels[label].name;
    part.graph.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2 + static_cast<double>(label), 0, 0 } };
    part.graph.radius = { 1, 1, 1 };
    part.graph.erosionThickness = { 0, 0, 0 };
    SortBranches(part.graph, { { 0, 1, 2 } }, true);
    part.table = MeasureBranches(part.graph);
    return part;
  }

  /** Writes both labels; gives the names that are there then. */
  std::set<std::string>
  Write(const std::string & output, const SkeletonTargets & targets)
  {
    OutputTransaction        transaction(false);
    SkeletonFiles            files(output, At("scan.nii.gz"), targets, transaction);
    std::vector<std::string> notes;
    for (std::size_t label = 0; label < 2; ++label)
    {
      ModelPart surface;
      surface.label = m_Report.labels[label].label;
      files.Add(m_Report, label, Part(label), surface, notes);
    }
    files.Finish(m_Report, notes);
    transaction.Commit();
    return Names();
  }

  CoreReport m_Report;
};

TEST_F(SkeletonFilesOfJobs, StandBesideTheResult)
{
  EXPECT_EQ(Write(At("out.vtp"), { {}, { "csv", "swc", "mrk.json", "graphml" } }),
            (std::set<std::string>{ "out.vtp",
                                    "out_branches.csv",
                                    "out_summary.csv",
                                    "out_columns.json",
                                    "out.swc",
                                    "out.mrk.json",
                                    "out.graphml" }));
  EXPECT_EQ(ReadSkeletonVtp(At("out.vtp")).parts.size(), 2U);
  EXPECT_EQ(m_Report.labels[1].skeleton->output, At("out.vtp"));
}

/** A number of four bytes, the lowest first. */
template <typename T>
T
NumberAt(const std::string & bytes, std::size_t index)
{
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i-- > 0;)
  {
    bits = bits << 8U | static_cast<unsigned char>(bytes.at(4 * index + i));
  }
  return std::bit_cast<T>(bits);
}

TEST_F(SkeletonFilesOfJobs, LinesAreAnObjectALabelInObj)
{
  Write(At("out.vtp"), { {}, { "obj" } });
  EXPECT_EQ(Bytes("out.obj"),
            "# VoxelCore curve skeleton, mm\n# SPACE=LPS\n"
            "o label_2\nv 0 0 0\nv 1 0 0\nv 2 0 0\ng branch_0\nl 1 2 3\n"
            "o label_5\nv 0 0 0\nv 1 0 0\nv 3 0 0\ng branch_0\nl 4 5 6\n");
}

TEST_F(SkeletonFilesOfJobs, APrecomputedFolderHasAFileALabelInNanometres)
{
  for (const std::string output : { "out.vtp", "folder/" })
  {
    SCOPED_TRACE(output);
    Write(At(output), { {}, { "precomputed" } });
    const std::string folder = output == "out.vtp" ? "out_precomputed/" : "folder/scan_skeleton_precomputed/";
    EXPECT_NE(Bytes(folder + "info").find("neuroglancer_skeletons"), std::string::npos);
    EXPECT_NE(Bytes(folder + "names/info").find("\"n5\""), std::string::npos);
    const std::string bytes = Bytes(folder + "5");
    ASSERT_EQ(bytes.size(), 4U * (2 + 3 * 3 + 2 * 2 + 3));
    EXPECT_EQ(NumberAt<std::uint32_t>(bytes, 0), 3U);
    EXPECT_EQ(NumberAt<std::uint32_t>(bytes, 1), 2U);
    EXPECT_EQ(NumberAt<float>(bytes, 2 + 6), 3e6F); // x of the third point
    EXPECT_EQ(NumberAt<std::uint32_t>(bytes, 11), 0U);
    EXPECT_EQ(NumberAt<std::uint32_t>(bytes, 14), 2U);
    EXPECT_EQ(NumberAt<float>(bytes, 15), 1e6F); // the radius of the first
  }
}

TEST_F(SkeletonFilesOfJobs, ATableTakesThePlaceOfTheBranches)
{
  EXPECT_EQ(
    Write(At("out.vtp"), { At("mine.csv"), { "csv" } }),
    (std::set<std::string>{ "out.vtp", "mine.csv", "mine_columns.json", "out_summary.csv", "out_columns.json" }));
}

TEST_F(SkeletonFilesOfJobs, AnOutputOfCsvMeansTablesAlone)
{
  EXPECT_EQ(Write(At("out.csv"), {}),
            (std::set<std::string>{ "out_branches.csv", "out_summary.csv", "out_columns.json" }));
}

TEST_F(SkeletonFilesOfJobs, AFolderHasAFileForEachLabelAndOneTable)
{
  EXPECT_EQ(Write(At("out/"), { {}, { "csv", "swc" } }), (std::set<std::string>{ "out" }));
  std::set<std::string> names;
  for (const auto & entry : std::filesystem::directory_iterator(At("out")))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{ "scan_label-2_skeleton.vtp",
                                    "scan_label-2_skeleton.swc",
                                    "scan_label-5_skeleton.vtp",
                                    "scan_label-5_skeleton.swc",
                                    "scan_skeleton_branches.csv",
                                    "scan_skeleton_summary.csv",
                                    "scan_skeleton_columns.json" }));
  const std::string table = Bytes("out/scan_skeleton_branches.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << "a head and a row per label";
}

TEST_F(SkeletonFilesOfJobs, AFinishedLabelOfAFolderIsInTheTablesAgain)
{
  Write(At("out/"), { {}, { "csv" } });
  const std::string first = Bytes("out/scan_skeleton_branches.csv");
  {
    OutputTransaction        transaction(true);
    SkeletonFiles            files(At("out/"), At("scan.nii.gz"), { {}, { "csv" } }, transaction);
    std::vector<std::string> notes;
    EXPECT_EQ(files.FolderTarget(2, 0), At("out/scan_label-2_skeleton.vtp"));
    EXPECT_EQ(files.FolderTables().size(), 3U);
    for (std::size_t label = 0; label < 2; ++label)
    {
      m_Report.labels[label].skeleton->numbers = {};
      files.AddFinished(m_Report, label);
      EXPECT_EQ(m_Report.labels[label].skeleton->numbers.branches, 1);
    }
    files.Finish(m_Report, notes);
    transaction.Commit();
  }
  const std::string again = Bytes("out/scan_skeleton_branches.csv");
  EXPECT_EQ(std::count(again.begin(), again.end(), '\n'), std::count(first.begin(), first.end(), '\n'));
}

TEST_F(SkeletonFilesOfJobs, WhatCannotBeWrittenIsRefusedAtOnce)
{
  const auto make = [&](const std::string & output, const SkeletonTargets & targets) {
    OutputTransaction   transaction(false);
    const SkeletonFiles files(At(output), At("scan.nii.gz"), targets, transaction);
    return files.NeedsSurface();
  };
  EXPECT_THROW(make("out.stl", {}), UsageError);
  WriteAll(At("out.swc"), "mine");
  WriteAll(At("out_summary.csv"), "mine");
  EXPECT_THROW(make("out.vtp", { {}, { "swc" } }), OutputError);
  EXPECT_THROW(make("out.vtp", { {}, { "csv" } }), OutputError);
  EXPECT_THROW(make("none/out.vtp", {}), OutputError);
  EXPECT_FALSE(make("out.vtp", { {}, { "graphml" } }));
  EXPECT_TRUE(make("out.vtp", { {}, { "ma" } }));
  EXPECT_EQ(Names(), (std::set<std::string>{ "out.swc", "out_summary.csv" }));
}

TEST_F(SkeletonFilesOfJobs, CutsAndClosedSurfacesAreTold)
{
  OutputTransaction        transaction(false);
  SkeletonFiles            files(At("out.vtp"), At("scan.nii.gz"), {}, transaction);
  std::vector<std::string> notes;
  m_Report.labels[0].skeleton->cuts = { { { 1, 2, 3 }, 0.5 } };
  m_Report.labels[1].skeleton->numbers.closedFaces = 12;
  files.Add(m_Report, 0, Part(0), {}, notes);
  files.Add(m_Report, 1, Part(1), {}, notes);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("label 2 (n2): a cycle was cut at"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("label 5 (n5): 12 faces of closed surfaces stay"), std::string::npos) << notes[1];
}

} // namespace
} // namespace voxelcore::testing
