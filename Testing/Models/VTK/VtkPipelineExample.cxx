// VoxelCore in a VTK pipeline: from a scan to the medial surface pruned to two lambdas.
// usage: VtkPipelineExample SCAN.mha LAMBDA LAMBDA OUT.vtp    the lambdas in mm; OUT.vtp is of the second

#include <vtkLambdaPruningFilter.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelCoreFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 5)
  {
    std::cerr << "usage: VtkPipelineExample SCAN.mha LAMBDA LAMBDA OUT.vtp\n";
    return 2;
  }
  vtkNew<vtkMetaImageReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkVoxelCoreFilter> core;
  core->SetInputConnection(reader->GetOutputPort());
  core->ImageIsInLPSOn(); // MetaImage is
  core->WholeCoreOn();    // by default it is pruned by tolerance and refined
  vtkNew<vtkLambdaPruningFilter> pruned;
  pruned->SetInputConnection(core->GetOutputPort());
  for (const char * lambda : { argv[2], argv[3] }) // the second prunes anew, and does nothing else
  {
    pruned->SetLambda(std::atof(lambda));
    pruned->Update();
    std::cout << "lambda " << lambda << " mm: " << pruned->GetOutput()->GetNumberOfPolys() << " polygons\n";
  }
  if (core->GetErrorCode() != 0 || pruned->GetErrorCode() != 0)
  {
    return 1; // there is no result, and nothing to write
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(pruned->GetOutputPort());
  writer->SetFileName(argv[4]);
  // So that `voxelcore` takes the file, too.
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  return writer->Write() == 1 ? 0 : 1;
}
