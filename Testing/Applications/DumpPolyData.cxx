// Tells, as JSON, what VTK's reader finds in a .vtp file: an opinion that is not VoxelCore's own.

#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 2)
  {
    return 2;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkPolyData * const data = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || data->GetNumberOfPoints() == 0)
  {
    std::cerr << argv[1] << ": VTK cannot read it, or it is empty\n";
    return 1;
  }
  nlohmann::json json;
  json["verts"] = data->GetNumberOfVerts();
  json["lines"] = data->GetNumberOfLines();
  json["polys"] = data->GetNumberOfPolys();
  auto * const space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE"));
  json["space"] = space != nullptr ? std::string(space->GetValue(0)) : std::string();
  json["points"] = nlohmann::json::array();
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    double at[3];
    data->GetPoint(point, at);
    json["points"].push_back({ at[0], at[1], at[2] });
  }
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i)
  {
    json["pointArrays"].push_back(data->GetPointData()->GetArrayName(i));
  }
  vtkDataArray * const radius = data->GetPointData()->GetArray("Radius");
  for (vtkIdType point = 0; radius != nullptr && point < radius->GetNumberOfTuples(); ++point)
  {
    json["radii"].push_back(radius->GetTuple1(point));
  }
  std::vector<double>  labels;
  vtkDataArray * const label = data->GetCellData()->GetArray("Label");
  for (vtkIdType cell = 0; label != nullptr && cell < label->GetNumberOfTuples(); ++cell)
  {
    labels.push_back(label->GetTuple1(cell));
  }
  json["pointLabels"] = std::vector<double>(static_cast<std::size_t>(data->GetNumberOfPoints()), 0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells() && label != nullptr; ++cell)
  {
    data->GetCellPoints(cell, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      json["pointLabels"][static_cast<std::size_t>(corners->GetId(k))] = labels[static_cast<std::size_t>(cell)];
    }
  }
  std::cout << json << '\n';
  return 0;
}
