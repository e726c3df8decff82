#include "ModelFormats.h"
#include "VtkMessages.h"
#include "voxelcore/ModelPolyData.h"
#include "voxelcore/OutputStream.h"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cerrno>
#include <locale>

namespace voxelcore
{
namespace
{

/** Writes to a stream that keeps the reason of a failure. By itself VTK loses it, and removes whatever has the name. */
class StreamedPolyDataWriter : public vtkXMLPolyDataWriter
{
public:
  static StreamedPolyDataWriter *
  New();
  vtkTypeMacro(StreamedPolyDataWriter, vtkXMLPolyDataWriter);

  void
  SetStream(std::ostream * stream)
  {
    this->Stream = stream;
  }

protected:
  int
  WriteInternal() override
  {
    this->Stream->imbue(std::locale::classic());
    return this->WriteData();
  }
};

vtkStandardNewMacro(StreamedPolyDataWriter);

} // namespace

void
WriteVtp(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  OutputStream                   stream(path);
  const VtkMessages              messages;
  vtkNew<StreamedPolyDataWriter> writer;
  writer->SetInputData(MakePolyData(model, keepEdges));
  writer->SetFileName(path.c_str());
  writer->SetStream(&stream);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  // LZ4 makes 18 MB into 7 but takes three times as long to write, and its bytes change with the library's version.
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  writer->SetByteOrderToLittleEndian();
  const bool written = writer->Write() == 1;
  writer->SetStream(nullptr);
  const bool complete =
    written && stream.good() && writer->GetErrorCode() == vtkErrorCode::NoError && messages.First().empty();
  if (!complete && stream.good())
  {
    FailOutput(path, EIO); // of VTK's own
  }
  stream.Finish();
}

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
