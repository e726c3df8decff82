#include "JobFolder.h"

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Shape/LabelContacts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

using Rows = std::vector<std::map<std::string, std::string>>;

Rows
ReadTable(const std::string & text)
{
  std::istringstream       lines(text);
  std::string              line;
  std::vector<std::string> head;
  Rows                     rows;
  while (std::getline(lines, line))
  {
    std::vector<std::string> fields(1);
    for (const char c : line)
    {
      c == ',' ? fields.emplace_back().clear() : fields.back().push_back(c);
    }
    if (head.empty())
    {
      head = fields;
      continue;
    }
    EXPECT_EQ(fields.size(), head.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < head.size(); ++i)
    {
      rows.back()[head[i]] = fields[i];
    }
  }
  return rows;
}

class NetworkLabelsJob : public JobFolder
{
protected:
  SkeletonResult
  Skeleton(const std::string & output, ParameterValues more = {}) const
  {
    more.insert({ { "scan", At("a.nrrd") }, { "output", At(output) } });
    return RunSkeletonJob(SkeletonOptionsFrom(more));
  }
};

TEST_F(NetworkLabelsJob, VesselsAreOneRingWithANodeAtEachContact)
{
  Phantom("vessels", "a.nrrd", "64");
  const SkeletonResult network =
    Skeleton("n.vtp", { { "network", "true" }, { "also", "csv,swc,graphml,mrk.json" }, { "report", At("n.json") } });
  const SkeletonResult whole = Skeleton("w.vtp", { { "binary", "true" } });
  const auto &         record = *network.report.labels.at(0).skeleton;
  EXPECT_EQ(record.numbers.cycles, 1);
  EXPECT_EQ(record.numbers.components, 1);
  const double length = whole.report.labels.at(0).skeleton->numbers.totalLength;
  EXPECT_NEAR(record.numbers.totalLength, length, 0.005 * length);
  for (const std::string & note : network.notes)
  {
    ADD_FAILURE() << note;
  }

  // The contacts are those of the voxels, each with one node at which branches of both labels end.
  const LabelMap scan = ReadLabelVolume(At("a.nrrd"), {});
  const auto     contacts = FindLabelContacts(scan.labels, scan.geometry);
  EXPECT_GE(contacts.size(), 12U);
  const Rows rows = ReadTable(Bytes("n_contacts.csv"));
  ASSERT_EQ(rows.size(), contacts.size());
  const SkeletonModel model = ReadSkeletonVtp(At("n.vtp"));
  ASSERT_EQ(model.parts.size(), 1U);
  const SkeletonGraph & graph = model.parts[0].graph;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto & row = rows[i];
    EXPECT_EQ(row.at("label_a"), std::to_string(scan.labels[contacts[i].labels[0]].value));
    EXPECT_EQ(row.at("label_b"), std::to_string(scan.labels[contacts[i].labels[1]].value));
    EXPECT_EQ(row.at("faces"), std::to_string(contacts[i].faces));
    EXPECT_EQ(row.at("nodes"), "1");
    std::set<std::string> labels;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      for (const ElementIndex node : graph.branchNodes[branch])
      {
        if (std::to_string(node) == row.at("node_id"))
        {
          labels.insert(std::to_string(graph.BranchLabel(branch)));
        }
      }
    }
    EXPECT_TRUE(labels.contains(row.at("label_a")) && labels.contains(row.at("label_b"))) << i;
  }

  // Rows of labels sum up to that of the network, which is called label 0.
  double sum = 0;
  double all = 0;
  int    labels = 0;
  for (const auto & row : ReadTable(Bytes("n_summary.csv")))
  {
    if (row.at("level") == "all")
    {
      (row.at("label") == "0" ? all : sum) += std::stod(row.at("total_length"));
      labels += row.at("label") == "0" ? 0 : 1;
      EXPECT_GT(std::stod(row.at("total_length")), 0) << row.at("label");
    }
  }
  EXPECT_EQ(labels, 12);
  EXPECT_NEAR(sum, all, 1e-4 * all);
  const auto json = nlohmann::json::parse(Bytes("n.json"));
  EXPECT_EQ(json.at("labels").at(0).at("skeleton").at("network").at("contacts").size(), contacts.size());
  EXPECT_EQ(json.at("labels").at(0).at("skeleton").at("network").at("labels").size(), 12U);
  EXPECT_NE(Bytes("n.graphml").find(">contact<"), std::string::npos);
  EXPECT_NE(Bytes("n.swc").find("# label 12 "), std::string::npos);
}

TEST_F(NetworkLabelsJob, MeasuringAFinishedNetworkGivesItsTablesAgain)
{
  Phantom("vessels", "a.nrrd", "40");
  Skeleton("n.vtp", { { "network", "true" }, { "also", "csv" } });
  RunMeasureJob(MeasureOptionsFrom({ { "skeleton", At("n.vtp") }, { "output", At("m.csv") } }));
  for (const char * table : { "_branches.csv", "_summary.csv", "_contacts.csv", "_columns.json" })
  {
    EXPECT_EQ(Bytes(std::string("n") + table), Bytes(std::string("m") + table)) << table;
  }
  RunMeasureJob(MeasureOptionsFrom({ { "skeleton", At("n.vtp") }, { "output", At("c.vtp") }, { "cut-loops", "" } }));
  const SkeletonModel   cut = ReadSkeletonVtp(At("c.vtp"));
  const SkeletonGraph & graph = cut.parts.at(0).graph;
  EXPECT_EQ(MeasureBranches(graph).numbers.cycles, 0);
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const ElementIndex point : graph.Branch(branch))
    {
      EXPECT_TRUE(graph.contact[point] || graph.labels[point] == graph.BranchLabel(branch));
    }
  }
}

TEST_F(NetworkLabelsJob, WhatDoesNotGoTogetherIsRefused)
{
  Phantom("ball", "a.nrrd");
  EXPECT_THROW(Skeleton("n.vtp", { { "network", "true" } }), InputError); // one label
  Phantom("vessels", "b.nrrd", "40");
  const ParameterValues network{ { "network", "true" }, { "scan", At("b.nrrd") } };
  for (const char * other : { "binary", "split-components", "plates" })
  {
    ParameterValues both = network;
    both[other] = "2vox";
    EXPECT_THROW(Skeleton("n.vtp", both), UsageError) << other;
  }
  EXPECT_THROW(Skeleton("folder/", network), UsageError);
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd", "b.nrrd" }));
}

} // namespace
} // namespace voxelcore::testing
