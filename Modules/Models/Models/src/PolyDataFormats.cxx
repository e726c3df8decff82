#include "ModelFormats.h"
#include "VtkMessages.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>

#include <cerrno>

namespace voxelcore
{

void
WriteVtk(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  OutputFile                file(path);
  const VtkMessages         messages;
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(MakePolyData(model, keepEdges));
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2); // as Slicer writes; 5.1 is new to many tools
  writer->SetFileTypeToBinary();
  writer->SetHeader(("VoxelCore medial surface. SPACE=LPS Units=" + UnitName(model.unit)).c_str());
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError || !messages.First().empty())
  {
    FailOutput(path, ENOMEM);
  }
  file.Write(writer->GetOutputString(), static_cast<std::size_t>(writer->GetOutputStringLength()));
  file.Finish();
}

} // namespace voxelcore
