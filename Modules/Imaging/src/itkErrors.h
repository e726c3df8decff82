#pragma once
// VoxelCore's errors, abort and progress in ITK's terms.

#include "itkProcessObject.h"

#include "voxelcore/Progress.h"
#include "voxelcore/TopologyNumbers.h"

#include <algorithm>
#include <new>
#include <string>

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

/** \throws voxelcore::CertificateError when a complex has not the topology of its shape. */
inline void
RequireEqualTopology(const voxelcore::TopologyNumbers & shape,
                     const voxelcore::TopologyNumbers & complex,
                     const char *                       what,
                     std::int64_t                       label)
{
  const auto text = [](const voxelcore::TopologyNumbers & numbers) {
    return std::to_string(numbers.euler) + "/" + std::to_string(numbers.betti[0]) + "/" +
           std::to_string(numbers.betti[1]) + "/" + std::to_string(numbers.betti[2]);
  };
  if (!(shape == complex))
  {
    throw voxelcore::CertificateError("label " + std::to_string(label) +
                                      ": certificate failed: the shape has chi/b0/b1/b2 " + text(shape) + ", " + what +
                                      " has " + text(complex) + "; there is no output");
  }
}

} // namespace itk
