// What the ITK filters make of a scan, for refused_test.sh, which links this with SeededFault.cxx.
// usage: ItkWay whole|pruned|exact|refined SCAN OUT.vtp    a core: whole, by lambda, by tolerance, refined
//        ItkWay thickness SCAN OUT.mha

#include "itkImageFileWriter.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLabelScanReader.h"
#include "itkLambdaPruningFilter.h"
#include "itkLocalThicknessImageFilter.h"
#include "itkMetaImageIO.h"
#include "itkVoxelCoreFilter.h"

#include "voxelcore/Models/MedialModel.h"

#include <iostream>
#include <string>

namespace
{

void
WriteCores(const itk::MedialComplexObject & cores, const std::string & path)
{
  voxelcore::MedialModel model;
  for (const auto & part : cores.GetParts())
  {
    model.parts.push_back(part.core->core);
  }
  const voxelcore::ModelOptions options{ .keepEdges = true };
  model.unit = cores.GetGeometry().unit;
  model.refined = cores.GetRefined();
  model.provenance = cores.GetProvenance(options.keepEdges);
  voxelcore::WriteModel(path, path, model, options);
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: ItkWay WHAT SCAN OUT\n";
    return 2;
  }
  const std::string what = argv[1];
  try
  {
    using ImageType = itk::Image<unsigned short, 3>;
    auto reader = itk::LabelScanReader<ImageType>::New();
    reader->SetFileName(argv[2]);
    auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
    shapes->SetInput(reader->GetOutput());
    if (what == "thickness")
    {
      auto thickness = itk::LocalThicknessImageFilter::New();
      thickness->SetInput(shapes->GetOutput());
      thickness->Update();
      auto writer = itk::ImageFileWriter<itk::LocalThicknessImageFilter::OutputImageType>::New();
      writer->SetImageIO(itk::MetaImageIO::New());
      writer->SetInput(thickness->GetOutput());
      writer->SetFileName(argv[3]);
      writer->Update();
      return 0;
    }
    auto core = itk::VoxelCoreFilter::New();
    core->SetInput(shapes->GetOutput());
    core->SetWholeCore(what == "whole" || what == "pruned");
    core->SetRefine(what == "refined");
    if (what != "pruned")
    {
      core->Update();
      WriteCores(*core->GetOutput(), argv[3]);
      return 0;
    }
    auto pruned = itk::LambdaPruningFilter::New();
    pruned->SetInput(core->GetOutput());
    pruned->SetLambda("2vox");
    pruned->Update();
    WriteCores(*pruned->GetOutput(), argv[3]);
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
