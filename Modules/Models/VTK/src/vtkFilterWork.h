#pragma once
// VoxelCore's errors, abort and progress in VTK's terms.

#include "voxelcore/Base/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkErrorCode.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cerrno>
#include <new>

/** Fills `output` with what `work` returns. When it throws, `output` is empty; what it throws is reported as an error
 *  of `filter`, but for an abort, which is none, and `setError` gets its code. Returns what RequestData has to
 *  return. */
template <typename SetError, typename Work>
int
vtkFilterWork(vtkAlgorithm * filter, const SetError & setError, vtkPolyData * output, const Work & work)
{
  output->Initialize();
  setError(vtkErrorCode::NoError);
  try
  {
    output->ShallowCopy(work());
    return 1;
  }
  catch (const voxelcore::Cancelled &)
  {
    return 1;
  }
  catch (const std::bad_alloc &)
  {
    setError(ENOMEM); // VTK's codes below its own are the system's
    vtkErrorWithObjectMacro(filter, "not enough memory");
  }
  catch (const std::exception & error)
  {
    setError(vtkErrorCode::UnknownError);
    vtkErrorWithObjectMacro(filter, << error.what());
  }
  return 0;
}

/** Forwards progress to `filter` as its `from` to `to`, never backwards, and its abort to the caller. */
inline voxelcore::ProgressCallback
vtkForwardProgress(vtkAlgorithm * filter, double from, double to)
{
  return [filter, from, to, reached = from](std::string_view, double fraction) mutable {
    reached = std::max(reached, from + (to - from) * std::clamp(fraction, 0.0, 1.0));
    filter->UpdateProgress(reached);
    return filter->GetAbortExecute() == 0;
  };
}
