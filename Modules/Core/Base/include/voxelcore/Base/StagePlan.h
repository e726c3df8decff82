#pragma once
// Progress of work in parts.

#include "voxelcore/Base/Progress.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** A callback for a part of the work: its fractions 0 to 1 become `from` to `to` of `outer`, its stage stays. */
inline ProgressCallback
PartOfProgress(const ProgressCallback & outer, double from, double to)
{
  if (!outer)
  {
    return {};
  }
  return [outer, from, to](std::string_view stage, double fraction) {
    return outer(stage, from + (to - from) * std::clamp(fraction, 0.0, 1.0));
  };
}

/** The same, and its stage becomes `name`. */
inline ProgressCallback
PartOfProgress(const ProgressCallback & outer, std::string name, double from, double to)
{
  if (!outer)
  {
    return {};
  }
  return [part = PartOfProgress(outer, from, to), name = std::move(name)](std::string_view, double fraction) {
    return part(name, fraction);
  };
}

/** PartOfProgress() that puts `name` before the stage. */
inline ProgressCallback
NamedPartOfProgress(const ProgressCallback & outer, std::string name, double from, double to)
{
  if (!outer)
  {
    return {};
  }
  return [part = PartOfProgress(outer, from, to), name = std::move(name)](std::string_view stage, double fraction) {
    return part(name + ": " + std::string(stage), fraction);
  };
}

/** A callback whose fractions, limited to 0 to 1, never go back. Stages that only ask whether to stop report what they
 *  like; jobs are watched through it. Copies of it count as one. */
inline ProgressCallback
ForwardOnly(const ProgressCallback & outer)
{
  if (!outer)
  {
    return {};
  }
  return [outer, most = std::make_shared<double>(0)](std::string_view stage, double fraction) {
    *most = std::max(*most, std::clamp(fraction, 0.0, 1.0));
    return outer(stage, *most);
  };
}

/** Work in stages, one after the other, each with its share of the whole time. */
class StagePlan
{
public:
  /** `weights`: of all stages, in their order, in any unit; not all 0. */
  StagePlan(ProgressCallback outer, std::vector<double> weights)
    : m_Outer(std::move(outer))
    , m_Weights(std::move(weights))
    , m_All(std::accumulate(m_Weights.begin(), m_Weights.end(), 0.0))
  {}

  /** The callback of the next stage; what came before counts as done. An empty name leaves the stages their own. */
  ProgressCallback
  Next(std::string name = "")
  {
    const double from = m_Done / m_All;
    m_Done += m_Weights.at(m_Next++);
    const double to = m_Next == m_Weights.size() ? 1.0 : m_Done / m_All;
    return name.empty() ? PartOfProgress(m_Outer, from, to) : PartOfProgress(m_Outer, std::move(name), from, to);
  }

private:
  ProgressCallback    m_Outer;
  std::vector<double> m_Weights;
  double              m_All;
  double              m_Done = 0;
  std::size_t         m_Next = 0;
};

} // namespace voxelcore
