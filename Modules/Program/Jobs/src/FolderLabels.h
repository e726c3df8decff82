#pragma once
// Which labels of a folder a run that was stopped has finished.

#include "FinishedLabels.h"
#include "ResultFiles.h"
#include "voxelcore/Jobs/SkeletonFiles.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Where a folder says which of its labels are finished. */
inline std::filesystem::path
FinishedLabelsPath(const CoreOptions & options)
{
  const bool isCore = !options.output.empty();
  return (isCore ? options.output : options.skeletonOutput) /
         (ScanName(options.scan) + (isCore ? "_medial" : "_skeleton") + "_finished.jsonl");
}

/** The labels of a folder, of which some are finished. */
class FolderLabels
{
public:
  /** Takes out of `labels` those that are finished. Refuses before hours of work what could not be written in the
   *  end. */
  FolderLabels(const CoreOptions &        options,
               std::vector<EditedLabel> & labels,
               const ResultFiles &        files,
               const SkeletonFiles *      skeletons,
               const OutputTransaction &  transaction,
               const CoreReport &         report)
    : m_Finished(FinishedLabelsPath(options), LabelKey(report, KeyText(skeletons)))
  {
    std::vector<EditedLabel> left;
    for (EditedLabel & one : labels)
    {
      auto known = m_Finished.Find(one.label.value, one.component, one.label.name);
      if (!known)
      {
        LabelRecord record;
        record.label = one.label.value;
        record.component = one.component;
        for (const std::filesystem::path & target : files.Targets(record))
        {
          transaction.CheckTarget(target);
        }
        if (skeletons != nullptr)
        {
          transaction.CheckTarget(skeletons->FolderTarget(record.label, record.component));
        }
        left.push_back(std::move(one));
      }
      m_Known.push_back(std::move(known));
    }
    labels = std::move(left);
    for (const std::filesystem::path & table :
         skeletons != nullptr ? skeletons->FolderTables() : std::vector<std::filesystem::path>())
    {
      if (!m_Finished.IsTable(table))
      {
        transaction.CheckTarget(table);
      }
    }
  }

  std::size_t
  CountFinished() const
  {
    return static_cast<std::size_t>(
      std::count_if(m_Known.begin(), m_Known.end(), [](const auto & known) { return known.has_value(); }));
  }

  /** Hands over, in their order, the finished labels before the next that is not. */
  template <typename Take>
  void
  TakeFinished(Take && take)
  {
    for (; m_Next < m_Known.size() && m_Known[m_Next]; ++m_Next)
    {
      take(std::move(*m_Known[m_Next]));
    }
  }

  /** The next that was not finished has come. */
  void
  Pass()
  {
    ++m_Next;
  }

  FinishedLabels &
  Finished()
  {
    return m_Finished;
  }

private:
  static std::string
  KeyText(const SkeletonFiles * skeletons)
  {
    std::string text;
    for (const std::string & ending : skeletons != nullptr ? skeletons->Endings() : std::vector<std::string>())
    {
      text += ending == "csv" ? "" : ending + " "; // tables are of all labels
    }
    return text;
  }

  FinishedLabels                                    m_Finished;
  std::vector<std::optional<FinishedLabels::Label>> m_Known;
  std::size_t                                       m_Next = 0;
};

} // namespace voxelcore
