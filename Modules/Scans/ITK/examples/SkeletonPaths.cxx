// The branches of each label's curve skeleton as paths of ITK, drawn into an image: each branch has a value of its own.
// usage: SkeletonPaths LABELS OUT

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkMedialComplexToMeshFilter.h"

#include "voxelcore/Certified/Certified.h"

#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: SkeletonPaths LABELS OUT\n";
    return 2;
  }
  try
  {
    using ImageType = itk::Image<unsigned int, 3>;
    const auto labels = itk::ReadImage<ImageType>(argv[1]);
    auto       shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
    shapes->SetInput(labels);
    shapes->Update();

    auto drawn = ImageType::New();
    drawn->CopyInformation(labels);
    drawn->SetRegions(labels->GetLargestPossibleRegion());
    drawn->Allocate(true);
    unsigned int value = 0;
    for (const voxelcore::LabelShape & label : shapes->GetOutput()->GetLabels())
    {
      voxelcore::CertifiedRequest request;
      request.name = "label " + std::to_string(label.value);
      request.lambdas = { voxelcore::Lambda() };
      request.skeleton.emplace().standOut = voxelcore::ParseLambda("3vox"); // branches that stand out by less are noise
      const auto result = voxelcore::ComputeCertified(label.shape, shapes->GetOutput()->GetGeometry(), request);
      for (const auto & path : itk::PathsOfBranches(result.skeleton->skeleton.graph, *shapes->GetOutput()))
      {
        ++value;
        for (double at = path->StartOfInput(); at <= path->EndOfInput(); at += 0.25)
        {
          drawn->SetPixel(path->EvaluateToIndex(at), value);
        }
      }
    }
    itk::WriteImage(drawn, argv[2]);
    std::cout << value << " branches\n";
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << error.GetDescription() << '\n';
    return 1;
  }
  catch (const voxelcore::Error & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
