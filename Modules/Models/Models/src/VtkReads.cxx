// Whether VTK reads from a file what we do.

#include "VtkMessages.h"
#include "VtpFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace voxelcore
{

bool
RequireVtkReads(const std::filesystem::path & path, const MedialModel & model)
{
  if (LowerCase(path.extension().string()) == ".vtk")
  {
    return false;
  }
  try
  {
    // Every count was checked, on which VTK's reader relies; not so in the forms of other programs.
    if (!VtpFile(path, VtpFile::Content::All).IsOurs())
    {
      return false;
    }
  }
  catch (const UnfitFile & unfit) // it was fit a moment ago: the disk fails, or somebody writes to it
  {
    throw InputError("cannot read '" + path.string() + "' once more: " + unfit.reason +
                     "; see whether its disk fails or another program writes to it");
  }
  std::string trouble;
  {
    const VtkMessages            messages;
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    trouble = messages.First();
    if (trouble.empty() && reader->GetErrorCode() == 0)
    {
      try
      {
        if (SameBits(ModelFromPolyData(*reader->GetOutput()), model))
        {
          return true;
        }
        trouble = "it finds something else in it";
      }
      catch (const InputError & error)
      {
        trouble = error.what();
      }
    }
  }
  throw InputError(path.string() + ": VTK's reader does not open it (" + trouble + "); make the file again");
}

} // namespace voxelcore
