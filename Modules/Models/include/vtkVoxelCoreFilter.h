#pragma once
// VoxelCore in a VTK or ParaView pipeline.

#include <vtkPolyDataAlgorithm.h>

/** The whole voxel core of the labels of an image, as polydata: what `voxelcore core --lambda 0 --keep-edges` writes, its
 *  point arrays Radius and Lambda, cell arrays Lambda and Label, field arrays EdgeVertices and EdgeLambda. Points lie where
 *  the image lies (origin, spacing and direction; mm, and LPS if the image is in LPS, which is what SPACE then says).
 *
 *  Input: vtkImageData with point scalars of one component, whole numbers from 0; a pixel's point is its centre.
 *  Faults are reported by vtkErrorMacro and leave the output empty; so does AbortExecute. */
class vtkVoxelCoreFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkVoxelCoreFilter *
  New();
  vtkTypeMacro(vtkVoxelCoreFilter, vtkPolyDataAlgorithm);
  void
  PrintSelf(ostream & os, vtkIndent indent) override;

  /** The label to work on; 0, as at first: all but 0. */
  vtkSetMacro(Label, vtkTypeInt64);
  vtkGetMacro(Label, vtkTypeInt64);

protected:
  vtkVoxelCoreFilter() = default;
  ~vtkVoxelCoreFilter() override = default;
  int
  FillInputPortInformation(int port, vtkInformation * information) override;
  int
  RequestUpdateExtent(vtkInformation *        request,
                      vtkInformationVector ** inputs,
                      vtkInformationVector *  outputs) override;
  int
  RequestData(vtkInformation * request, vtkInformationVector ** inputs, vtkInformationVector * outputs) override;

private:
  vtkVoxelCoreFilter(const vtkVoxelCoreFilter &) = delete;
  void
  operator=(const vtkVoxelCoreFilter &) = delete;

  vtkTypeInt64 Label = 0;
};
