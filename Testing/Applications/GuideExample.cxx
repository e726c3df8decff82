// The program that the guide's page on C++ shows: scan.nii.gz in, medial.vtp out.

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Models/MedialModel.h"

int
main()
{
  const voxelcore::LabelMap   scan = voxelcore::ReadLabelVolume("scan.nii.gz");
  voxelcore::CertifiedRequest request;
  request.lambdas = { voxelcore::ParseLambda("1.5mm") }; // without this: tolerance 1.2diag, refined
  const auto result = voxelcore::ComputeCertified(scan.labels[0].shape, scan.geometry, request);

  voxelcore::MedialModel model;
  model.parts = { result.cores[0].core };
  model.unit = scan.geometry.unit; // mm, or voxels where the scan has no voxel size
  voxelcore::WriteModel("medial.vtp", "medial.vtp", model);
}
