#include "ModelSource.h"
#include "UnfitFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace voxelcore
{
namespace
{

class PolyDataSource : public ModelSource
{
public:
  explicit PolyDataSource(vtkPolyData & data)
    : m_Data(data)
  {}

  std::uint64_t
  PieceCount(const std::string & attribute) const override
  {
    const vtkIdType count = attribute == "NumberOfPoints"   ? m_Data.GetNumberOfPoints()
                            : attribute == "NumberOfStrips" ? m_Data.GetNumberOfStrips()
                                                            : CellsOf(attribute.substr(8))->GetNumberOfCells();
    return static_cast<std::uint64_t>(count);
  }

  bool
  Has(const std::string & section, const std::string & name) const override
  {
    return FieldsOf(section)->GetAbstractArray(name.c_str()) != nullptr;
  }

  std::vector<double>
  ReadReals(const std::string & section, const std::string & name, int components) override
  {
    vtkDataArray * const array = section == "Points" ? PointArray() : FieldsOf(section)->GetArray(name.c_str());
    RequireFit(array != nullptr && array->GetDataType() == VTK_DOUBLE,
               "an array is missing, or not in double precision");
    return CopyOf<double>(*array, components);
  }

  std::vector<std::int64_t>
  ReadWholes(const std::string & section, const std::string & name, int components) override
  {
    vtkDataArray * const array = FieldsOf(section)->GetArray(name.c_str());
    const int            type = array != nullptr ? array->GetDataType() : VTK_VOID;
    RequireFit(array != nullptr && array->GetDataTypeSize() == sizeof(std::int64_t) &&
                 (type == VTK_LONG || type == VTK_LONG_LONG || type == VTK_ID_TYPE),
               "an array is missing, or not of whole numbers of 64 bits");
    return CopyOf<std::int64_t>(*array, components);
  }

  std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name) override
  {
    vtkCellArray * const      cells = CellsOf(section);
    std::vector<std::int64_t> values;
    const bool                offsets = name == "offsets";
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      vtkIdType         count = 0;
      const vtkIdType * points = nullptr;
      cells->GetCellAtId(cell, count, points);
      if (offsets)
      {
        values.push_back((values.empty() ? 0 : values.back()) + count);
      }
      else
      {
        values.insert(values.end(), points, points + count);
      }
    }
    return values;
  }

  std::string
  ReadText(const std::string & section, const std::string & name) override
  {
    auto * const array = vtkStringArray::SafeDownCast(FieldsOf(section)->GetAbstractArray(name.c_str()));
    RequireFit(array != nullptr && array->GetNumberOfValues() == 1, "a text is missing");
    return array->GetValue(0);
  }

private:
  template <typename Value>
  static std::vector<Value>
  CopyOf(vtkDataArray & array, int components)
  {
    RequireFit(array.GetNumberOfComponents() == components, "an array has another number of components");
    const auto * const values = static_cast<const Value *>(array.GetVoidPointer(0));
    return { values, values + array.GetNumberOfValues() };
  }

  vtkDataArray *
  PointArray() const
  {
    RequireFit(m_Data.GetPoints() != nullptr, "it has no points");
    return m_Data.GetPoints()->GetData();
  }

  vtkFieldData *
  FieldsOf(const std::string & section) const
  {
    if (section == "PointData")
    {
      return m_Data.GetPointData();
    }
    return section == "CellData" ? m_Data.GetCellData() : m_Data.GetFieldData();
  }

  vtkCellArray *
  CellsOf(const std::string & section) const
  {
    return section == "Verts" ? m_Data.GetVerts() : section == "Lines" ? m_Data.GetLines() : m_Data.GetPolys();
  }

  vtkPolyData & m_Data;
};

} // namespace

MedialModel
ModelFromPolyData(vtkPolyData & data)
{
  try
  {
    PolyDataSource source(data);
    return ReadParts(source, true);
  }
  catch (const UnfitFile & unfit)
  {
    throw InputError("the polydata is no medial surface of VoxelCore: " + unfit.reason +
                     "; give what vtkVoxelCoreFilter makes");
  }
}

} // namespace voxelcore
