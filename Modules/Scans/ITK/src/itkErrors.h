#pragma once
// VoxelCore's errors, abort and progress in ITK's terms.

#include "itkProcessObject.h"

#include "voxelcore/Base/Progress.h"

#include <algorithm>
#include <new>

namespace itk
{

/** What `work` returns. What it throws becomes an ExceptionObject with the same one line, ProcessAborted or
 *  MemoryAllocationError. */
template <typename TWork>
auto
WithItkErrors(const char * where, const TWork & work) -> decltype(work())
{
  try
  {
    return work();
  }
  catch (const voxelcore::Cancelled &)
  {
    ProcessAborted aborted(__FILE__, __LINE__);
    aborted.SetLocation(where);
    throw aborted;
  }
  catch (const voxelcore::Error & error)
  {
    throw ExceptionObject(__FILE__, __LINE__, error.what(), where);
  }
  catch (const std::bad_alloc &)
  {
    throw MemoryAllocationError(__FILE__, __LINE__, "not enough memory", where);
  }
}

/** Forwards progress to `filter` as its `from` to `to`, never backwards, and its abort to the caller. */
inline voxelcore::ProgressCallback
ForwardProgress(ProcessObject * filter, double from, double to)
{
  return [filter, from, to, reached = from](std::string_view, double fraction) mutable {
    reached = std::max(reached, from + (to - from) * std::clamp(fraction, 0.0, 1.0));
    filter->UpdateProgress(static_cast<float>(reached));
    return !filter->GetAbortGenerateData();
  };
}

} // namespace itk
