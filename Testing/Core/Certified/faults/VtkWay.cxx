// What the VTK filters make of a scan, for refused_test.sh, which links this with SeededFault.cxx.
// usage: VtkWay whole|pruned|exact|refined SCAN.mha OUT.vtp    a core: whole, by lambda, by tolerance, refined

#include <vtkLambdaPruningFilter.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelCoreFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <iostream>
#include <string>

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: VtkWay WHAT SCAN.mha OUT.vtp\n";
    return 2;
  }
  const std::string          what = argv[1];
  vtkNew<vtkMetaImageReader> reader;
  reader->SetFileName(argv[2]);
  vtkNew<vtkVoxelCoreFilter> core;
  core->SetInputConnection(reader->GetOutputPort());
  core->ImageIsInLPSOn(); // MetaImage is
  core->SetWholeCore(what == "whole" || what == "pruned");
  core->SetRefine(what == "refined");
  vtkNew<vtkLambdaPruningFilter> pruned;
  pruned->SetInputConnection(core->GetOutputPort());
  pruned->SetLambda(2);
  vtkPolyDataAlgorithm * const last = what == "pruned" ? static_cast<vtkPolyDataAlgorithm *>(pruned) : core;
  last->Update();
  if (core->GetErrorCode() != 0 || last->GetErrorCode() != 0)
  {
    return 1;
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(last->GetOutput());
  writer->SetFileName(argv[3]);
  // So that `voxelcore` takes the file.
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  return writer->Write() == 1 ? 0 : 1;
}
