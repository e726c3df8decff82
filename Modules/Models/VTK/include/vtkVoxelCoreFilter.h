#pragma once
// VoxelCore in a VTK or ParaView pipeline.

#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkMatrix4x4;

/** The medial surface of the labels of an image, as polydata: what `voxelcore core --keep-edges` writes, pruned at
 *  tolerance 1.2diag and refined from the labels unless it is told otherwise. Point arrays Radius, Lambda, Tolerance,
 *  Displacement, cell arrays Lambda, Tolerance and Label, field arrays EdgeVertices, EdgeLambda and Provenance. With
 *  WholeCore on what `voxelcore core --lambda 0 --keep-edges` writes, which vtkLambdaPruningFilter prunes. Written by
 *  vtkXMLPolyDataWriter as raw appended data without compression, with headers of 64 bits, it is a file that
 *  `voxelcore verify`, `prune`, `skeleton` and `render` take.
 *
 *  Input: vtkImageData with point scalars of one component, whole numbers from 0; a pixel's point is its centre.
 *
 *  Where the points lie. They are placed by the image's origin, spacing and direction, in mm, and then by the matrix
 *  that was set, if any. The field SPACE says LPS where that is known to be so:
 *  - a matrix was set: it says how the image lies in the patient;
 *  - ImageIsInLPS is on: the caller knows that the image's own place is in LPS;
 *  - the image has a direction other than the identity: its source keeps directions, as ITK's does, and these are LPS.
 *  Else there is no field SPACE, and a file without it is refused by `voxelcore`: an identity may be what a reader left
 *  of a direction that it did not understand. vtkNIFTIImageReader drops it, but keeps it in a matrix:
 *  \code
 *    core->SetImageToRASMatrix(reader->GetQFormMatrix() ? reader->GetQFormMatrix() : reader->GetSFormMatrix());
 *  \endcode
 *  vtkNrrdReader drops it for good: set the matrix of the file's `space directions`, without the lengths of their
 *  vectors, as SetImageToLPSMatrix or SetImageToRASMatrix, whichever the file's `space` is.
 *
 *  The unit. Lengths are in mm, or in voxels where the image's scan gave no voxel size: its field data holds a string
 *  array Units that says voxel (as this filter's output then does), or LengthsInVoxels is on. An array Units that says
 *  neither mm nor voxel is a fault.
 *
 *  Faults are reported by vtkErrorMacro, set the ErrorCode and leave the output empty; AbortExecute leaves it empty. */
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

  /** Which voxels hang together: "6", as at first, those that share a face; "26", those that touch over edges and
   *  corners, too, which the least change then makes share faces; "joined": pieces that touch are joined, and nothing
   *  else changes. With "6" a warning says where pieces touch. */
  vtkSetStdStringFromCharMacro(Connectivity);
  vtkGetCharFromStdStringMacro(Connectivity);

  /** The whole voxel core, neither pruned nor refined; off at first. */
  vtkSetMacro(WholeCore, bool);
  vtkGetMacro(WholeCore, bool);
  vtkBooleanMacro(WholeCore, bool);

  /** How far the boundary may lie from the balls that remain, with its unit; "1.2diag" at first. */
  vtkSetStdStringFromCharMacro(Tolerance);
  vtkGetCharFromStdStringMacro(Tolerance);

  /** What is left above tolerance 0 is refined from the labels; on at first. Off: the exact core of the voxels. */
  vtkSetMacro(Refine, bool);
  vtkGetMacro(Refine, bool);
  vtkBooleanMacro(Refine, bool);

  /** Takes a place in the image (what vtkImageData::TransformIndexToPhysicalPoint gives, mm) to the patient: LPS mm, or
   *  RAS mm, whose first two coordinates then change sign. It is copied. None, as at first: nullptr. */
  void
  SetImageToLPSMatrix(vtkMatrix4x4 * matrix);
  void
  SetImageToRASMatrix(vtkMatrix4x4 * matrix);
  /** To LPS mm, however it was set; nullptr: none. */
  vtkMatrix4x4 *
  GetImageToLPSMatrix();

  /** The image's own origin, spacing and direction are known to be in LPS mm; off at first. */
  vtkSetMacro(ImageIsInLPS, bool);
  vtkGetMacro(ImageIsInLPS, bool);
  vtkBooleanMacro(ImageIsInLPS, bool);

  /** The image's spacing counts voxels and is no mm: its file gave none, and its reader left 1. Off by default; then
   *  the array Units of the image's field data decides. */
  vtkSetMacro(LengthsInVoxels, bool);
  vtkGetMacro(LengthsInVoxels, bool);
  vtkBooleanMacro(LengthsInVoxels, bool);

protected:
  vtkVoxelCoreFilter();
  ~vtkVoxelCoreFilter() override;
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

  vtkTypeInt64                  Label = 0;
  std::string                   Connectivity = "6";
  bool                          WholeCore = false;
  std::string                   Tolerance = "1.2diag";
  bool                          Refine = true;
  bool                          ImageIsInLPS = false;
  bool                          LengthsInVoxels = false;
  vtkSmartPointer<vtkMatrix4x4> ImageToLPS;
};
