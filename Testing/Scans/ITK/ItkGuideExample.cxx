// The ITK program that the guide's page on C++ shows: scan.nii.gz in, medial.vtp out.

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLabelScanReader.h"
#include "itkVoxelCoreFilter.h"
#include "voxelcore/Models/MedialModel.h"

int
main()
{
  using ImageType = itk::Image<unsigned short, 3>;
  auto reader = itk::LabelScanReader<ImageType>::New();
  reader->SetFileName("scan.nii.gz");
  auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
  shapes->SetInput(reader->GetOutput());
  auto core = itk::VoxelCoreFilter::New();
  core->SetInput(shapes->GetOutput());
  core->Update();

  voxelcore::MedialModel model;
  for (const auto & label : core->GetOutput()->GetParts())
    model.parts.push_back(label.core->core);
  model.unit = core->GetOutput()->GetGeometry().unit;
  model.provenance = core->GetOutput()->GetProvenance();
  model.refined = core->GetOutput()->GetRefined();
  voxelcore::WriteModel("medial.vtp", "medial.vtp", model);
}
