// VoxelCore in a VTK pipeline: a ball's voxels, its core, pruned twice.
// usage: VtkPipelineExample OUT.vtp

#include <vtkImageData.h>
#include <vtkLambdaPruningFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelCoreFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 2)
  {
    return 2;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(24, 24, 24);
  image->SetSpacing(0.5, 0.5, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int k = 0; k < 24; ++k)
  {
    for (int j = 0; j < 24; ++j)
    {
      for (int i = 0; i < 24; ++i)
      {
        const double x = i - 11.5;
        const double y = j - 11.5;
        const double z = k - 11.5;
        *static_cast<unsigned char *>(image->GetScalarPointer(i, j, k)) = x * x + y * y + z * z < 100 ? 1 : 0;
      }
    }
  }
  vtkNew<vtkVoxelCoreFilter> core;
  core->SetInputData(image);
  vtkNew<vtkLambdaPruningFilter> pruned;
  pruned->SetInputConnection(core->GetOutputPort());
  for (const double lambda : { 1.0, 2.0 }) // the second prunes anew, and computes nothing else
  {
    pruned->SetLambda(lambda);
    pruned->Update();
    std::cout << "lambda " << lambda << ": " << pruned->GetOutput()->GetNumberOfPolys() << " polygons\n";
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(pruned->GetOutputPort());
  writer->SetFileName(argv[1]);
  return writer->Write() == 1 ? 0 : 1;
}
