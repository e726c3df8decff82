#pragma once
// VoxelCore's errors, abort and progress in VTK's terms.

#include "voxelcore/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <new>

/** Fills `output` with what `work` returns. When it throws, `output` is empty; what it throws is reported as an error of
 *  `filter`, but for an abort, which is none. Returns what RequestData has to return. */
template <typename Work>
int
vtkFilterWork(vtkAlgorithm * filter, vtkPolyData * output, const Work & work)
{
  output->Initialize();
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
    vtkErrorWithObjectMacro(filter, "not enough memory");
  }
  catch (const std::exception & error)
  {
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
