#include "GuardedCollector.h"

namespace voxelcore
{

GuardedCollector::GuardedCollector(const ScanFile & scan, const ReadOptions & options, const CropRange & part)
  : m_Scan(scan)
  , m_Collector(std::in_place, scan, options, part)
{
  const bool layers = scan.interleaved > 1 && scan.component < 0;
  if (options.refuseGrey && options.labels == "all" && !options.binary && !options.threshold && !layers &&
      scan.segments.empty())
  {
    m_Test.emplace(scan, part);
  }
}

template <typename Work>
void
GuardedCollector::Guarded(const Work & work)
{
  if (!m_Collector)
  {
    return;
  }
  try
  {
    work(*m_Collector);
  }
  catch (const InputError &)
  {
    if (!m_Test)
    {
      throw;
    }
    m_NoLabel = std::current_exception();
    m_Collector.reset();
  }
}

void
GuardedCollector::AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  if (m_Test)
  {
    m_Test->AddRows(rows, firstRow, rowCount);
  }
  Guarded([&](LabelCollector & collector) { collector.AddRows(rows, firstRow, rowCount); });
}

void
GuardedCollector::FinishSlab()
{
  if (m_Test && !m_IsGrey && m_Test->IsTimeToLook() && m_Test->LooksGrey())
  {
    m_IsGrey = true;
    m_Collector.reset();
  }
  Guarded([](LabelCollector & collector) { collector.FinishSlab(); });
}

std::vector<LabelShape>
GuardedCollector::TakeShapes()
{
  if (m_Test && (m_IsGrey || m_Test->LooksGrey()))
  {
    RefuseGrey(m_Scan, *m_Test);
  }
  if (m_NoLabel)
  {
    std::rethrow_exception(m_NoLabel);
  }
  return m_Collector->TakeShapes();
}

} // namespace voxelcore
