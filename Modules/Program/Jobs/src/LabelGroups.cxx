#include "voxelcore/Jobs/LabelGroups.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <omp.h>

namespace voxelcore
{

namespace
{

/** What several labels have done, told to one callback. */
class SharedProgress
{
public:
  SharedProgress(const ProgressCallback & outer, std::vector<std::uint64_t> vertices)
    : m_Outer(outer)
    , m_Vertices(std::move(vertices))
    , m_Fractions(m_Vertices.size(), 0.0)
    , m_All(static_cast<double>(std::accumulate(m_Vertices.begin(), m_Vertices.end(), std::uint64_t{ 0 })))
  {}

  /** The callback of one of the labels. Copies of it count as one. */
  ProgressCallback
  Share(std::size_t label)
  {
    return [this, label](std::string_view stage, double fraction) { return Report(label, stage, fraction); };
  }

  bool
  IsStopped() const
  {
    const std::lock_guard lock(m_Mutex);
    return m_Stopped;
  }

private:
  bool
  Report(std::size_t label, std::string_view stage, double fraction)
  {
    const std::lock_guard lock(m_Mutex);
    if (fraction > m_Fractions[label])
    {
      m_Done += (std::min(fraction, 1.0) - m_Fractions[label]) * static_cast<double>(m_Vertices[label]);
      m_Fractions[label] = std::min(fraction, 1.0);
    }
    if (!m_Stopped && m_Outer && !m_Outer(stage, m_Done / m_All))
    {
      m_Stopped = true;
    }
    return !m_Stopped;
  }

  const ProgressCallback &   m_Outer;
  std::vector<std::uint64_t> m_Vertices;
  std::vector<double>        m_Fractions;
  double                     m_All;
  mutable std::mutex         m_Mutex;
  double                     m_Done = 0;
  bool                       m_Stopped = false;
};

} // namespace

std::vector<std::size_t>
GroupLabels(const std::vector<std::uint64_t> & boundaryVertices)
{
  std::vector<std::size_t> ends;
  std::uint64_t            sum = 0; // of the group being made; 0 when there is none
  for (std::size_t label = 0; label < boundaryVertices.size(); ++label)
  {
    const std::uint64_t vertices = boundaryVertices[label];
    const bool          small = vertices <= kSmallLabel;
    if (sum > 0 && (!small || sum + vertices > kGroupVertices))
    {
      ends.push_back(label);
      sum = 0;
    }
    if (small)
    {
      sum += vertices;
    }
    else
    {
      ends.push_back(label + 1);
    }
  }
  if (sum > 0)
  {
    ends.push_back(boundaryVertices.size());
  }
  return ends;
}

std::vector<LabelOutcome>
ProcessSideBySide(std::size_t                        first,
                  std::size_t                        end,
                  const std::vector<std::uint64_t> & boundaryVertices,
                  const LabelWork &                  work,
                  const ProgressCallback &           progress)
{
  const std::size_t        count = end - first;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), first);
  // Large ones first, so that no thread is left alone with one at the end.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return boundaryVertices[a] > boundaryVertices[b];
  });
  const auto     at = [&](std::size_t label) { return boundaryVertices.begin() + static_cast<std::ptrdiff_t>(label); };
  SharedProgress shared(progress, { at(first), at(end) });
  std::vector<LabelOutcome>       outcomes(count);
  std::vector<std::exception_ptr> failures(count);
  std::atomic<std::size_t>        firstFailure = end;
#pragma omp parallel
  {
    omp_set_num_threads(1); // of the loops within, for this thread
#pragma omp for schedule(dynamic, 1)
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t label = order[i];
      // Labels before one that failed still run: the first failure is what is told.
      if (label > firstFailure || shared.IsStopped())
      {
        continue;
      }
      try
      {
        outcomes[label - first] = work(label, shared.Share(label - first));
      }
      catch (...)
      {
        failures[label - first] = std::current_exception();
        std::size_t known = firstFailure;
        while (label < known && !firstFailure.compare_exchange_weak(known, label))
        {}
      }
    }
  }
  if (shared.IsStopped())
  {
    throw Cancelled();
  }
  if (firstFailure != end)
  {
    std::rethrow_exception(failures[firstFailure - first]);
  }
  return outcomes;
}

} // namespace voxelcore
