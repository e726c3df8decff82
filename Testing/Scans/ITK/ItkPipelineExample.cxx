// VoxelCore in an ITK pipeline: the pruned medial surface of every label of a scan.
// usage: ItkPipelineExample SCAN LAMBDA OUT.vtp

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLabelScanReader.h"
#include "itkLambdaPruningFilter.h"
#include "itkVoxelCoreFilter.h"

#include "voxelcore/Models/MedialModel.h"

#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: ItkPipelineExample SCAN LAMBDA OUT.vtp\n";
    return 2;
  }
  try
  {
    using ImageType = itk::Image<unsigned short, 3>;
    auto reader = itk::LabelScanReader<ImageType>::New();
    reader->SetFileName(argv[1]);
    auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
    shapes->SetInput(reader->GetOutput());
    shapes->SetNumberOfStreamDivisions(16);
    auto core = itk::VoxelCoreFilter::New();
    core->SetInput(shapes->GetOutput());
    core->WholeCoreOn(); // by default it is pruned by tolerance and refined
    auto pruned = itk::LambdaPruningFilter::New();
    pruned->SetInput(core->GetOutput());
    pruned->SetLambda(argv[2]);
    pruned->Update();

    voxelcore::MedialModel model;
    for (const auto & part : pruned->GetOutput()->GetParts())
    {
      model.parts.push_back(part.core->core);
    }
    // With the measures of all edges, and a record of what they are of, `voxelcore prune` and others take the file.
    const voxelcore::ModelOptions options{ .keepEdges = true };
    model.unit = pruned->GetOutput()->GetGeometry().unit;
    model.provenance = pruned->GetOutput()->GetProvenance(options.keepEdges);
    voxelcore::WriteModel(argv[3], argv[3], model, options);
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << error.GetDescription() << '\n';
    return 1;
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
