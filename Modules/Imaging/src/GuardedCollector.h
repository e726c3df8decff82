#pragma once
// A LabelCollector that a grey scan does not get far into.

#include "GreyTest.h"
#include "LabelCollector.h"

#include <exception>
#include <optional>

namespace voxelcore
{

/** As LabelCollector. With options.refuseGrey a GreyTest looks at the rows, too: once it finds the scan grey, or a value is
 *  no label, no more shapes are made, and TakeShapes() throws what is true of the whole scan. */
class GuardedCollector
{
public:
  GuardedCollector(const ScanFile & scan, const ReadOptions & options, const CropRange & part);

  void
  AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount);
  void
  FinishSlab();
  bool
  NeedsAllRows() const
  {
    return m_Collector->NeedsAllRows();
  }
  bool
  IsRenumbered() const
  {
    return m_Collector->Book().IsRenumbered();
  }
  /** \throws GreyScanError, and what LabelCollector throws */
  std::vector<LabelShape>
  TakeShapes();

private:
  /** Keeps what `work` throws where the scan may yet turn out grey. */
  template <typename Work>
  void
  Guarded(const Work & work);

  const ScanFile &              m_Scan;
  std::optional<LabelCollector> m_Collector;
  std::optional<GreyTest>       m_Test;
  bool                          m_IsGrey = false;
  std::exception_ptr            m_NoLabel;
};

} // namespace voxelcore
