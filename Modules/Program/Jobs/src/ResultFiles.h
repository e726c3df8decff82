#pragma once
// The files of cores a job writes: one for all labels, or a folder of one each.

#include "voxelcore/Base/Stopwatch.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Jobs/StagedModel.h"

#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** The result files of a run, in memory until their turn to be written. */
class ResultFiles
{
public:
  ResultFiles(const CoreOptions & options, bool toFolder, OutputTransaction & transaction, CoreResult & result)
    : m_Options(options)
    , m_ToFolder(toFolder)
    , m_Transaction(transaction)
    , m_Result(result)
    , m_Suffixes(ResultSuffixes(options.lambdas, options.tolerances))
    , m_Models(m_Suffixes.size())
  {}

  /** Takes a label's cores; in a folder they go to disk at once. */
  void
  Add(LabelRecord record, std::vector<ModelPart> parts)
  {
    if (m_Options.output.empty())
    {
      m_Result.report.labels.push_back(std::move(record));
      return;
    }
    for (std::size_t i = 0; i < m_Models.size(); ++i)
    {
      record.pruned[i].output = Target(record, i).string();
      m_Models[i].parts.push_back(std::move(parts[i]));
    }
    m_Result.report.labels.push_back(std::move(record));
    if (m_ToFolder)
    {
      Write({ m_Result.report.labels.size() - 1 });
    }
  }

  /** Takes what is in its folder already. */
  void
  AddFinished(LabelRecord record)
  {
    for (std::size_t i = 0; i < m_Models.size() && !m_Options.output.empty(); ++i)
    {
      record.pruned[i].output = Target(record, i).string();
    }
    m_Result.report.labels.push_back(std::move(record));
  }

  /** The files a label of a folder gets. */
  std::vector<std::filesystem::path>
  Targets(const LabelRecord & record) const
  {
    std::vector<std::filesystem::path> targets;
    for (std::size_t i = 0; i < m_Models.size() && !m_Options.output.empty(); ++i)
    {
      targets.push_back(Target(record, i));
    }
    return targets;
  }

  /** Writes what Add() kept. */
  void
  Finish()
  {
    if (!m_ToFolder && !m_Options.output.empty())
    {
      std::vector<std::size_t> all(m_Result.report.labels.size());
      std::iota(all.begin(), all.end(), std::size_t{ 0 });
      Write(all);
    }
  }

private:
  std::filesystem::path
  Target(const LabelRecord & record, std::size_t which) const
  {
    return m_ToFolder
             ? FolderOutputPath(m_Options.output, m_Options.scan, record.label, m_Suffixes[which], record.component)
             : FileOutputPath(m_Options.output, m_Suffixes[which]);
  }

  void
  Write(const std::vector<std::size_t> & labels)
  {
    Stopwatch watch;
    for (std::size_t i = 0; i < m_Models.size(); ++i)
    {
      MedialModel & model = m_Models[i];
      model.provenance = ProvenanceJson(m_Result.report, labels, i);
      model.hasEdges = m_Options.model.keepEdges;
      model.refined = m_Options.refine.surface;
      model.unit = m_Result.report.input.geometry.unit;
      const LabelRecord & first = m_Result.report.labels[labels.front()];
      WriteStagedModel(m_Transaction, Target(first, i), model, m_Options.model, m_Result.notes);
      model = MedialModel();
    }
    m_Result.report.seconds.write += watch.Lap();
  }

  const CoreOptions &      m_Options;
  bool                     m_ToFolder;
  OutputTransaction &      m_Transaction;
  CoreResult &             m_Result;
  std::vector<std::string> m_Suffixes;
  std::vector<MedialModel> m_Models; ///< one per lambda or tolerance
};

} // namespace voxelcore
