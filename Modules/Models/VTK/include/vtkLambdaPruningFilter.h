#pragma once
// Pruning in a VTK or ParaView pipeline: a slider away from another lambda.

#include <vtkPolyDataAlgorithm.h>

/** Prunes the output of vtkVoxelCoreFilter, or a .vtp that `voxelcore core --keep-edges` wrote, to a lambda in mm: what
 *  `voxelcore prune` gives. Edges keep their measures, so that filters can stand in a row.
 *  The field Provenance is carried on with the new lambda.
 *  Faults are reported by vtkErrorMacro, set the ErrorCode and leave the output empty; AbortExecute leaves it empty. */
class vtkLambdaPruningFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkLambdaPruningFilter *
  New();
  vtkTypeMacro(vtkLambdaPruningFilter, vtkPolyDataAlgorithm);
  void
  PrintSelf(ostream & os, vtkIndent indent) override;

  /** mm, not negative; 0, as at first: nothing is pruned. */
  vtkSetMacro(Lambda, double);
  vtkGetMacro(Lambda, double);

protected:
  vtkLambdaPruningFilter() = default;
  ~vtkLambdaPruningFilter() override = default;
  int
  RequestData(vtkInformation * request, vtkInformationVector ** inputs, vtkInformationVector * outputs) override;

private:
  vtkLambdaPruningFilter(const vtkLambdaPruningFilter &) = delete;
  void
  operator=(const vtkLambdaPruningFilter &) = delete;

  double Lambda = 0;
};
