#include "ModelSink.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <string_view>

namespace voxelcore
{
namespace
{

/** An array of `tuples` with `components`; its values are written through the pointer. */
template <typename ArrayType>
auto *
Allocate(ArrayType & array, const char * name, std::uint64_t tuples, int components = 1)
{
  array.SetName(name);
  array.SetNumberOfComponents(components);
  array.SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array.GetPointer(0);
}

class PolyDataSink : public ModelSink
{
public:
  explicit PolyDataSink(vtkPolyData & data)
    : m_Data(data)
  {}

  double *
  Reals(const char * section, const char * name, std::uint64_t tuples, int components) override
  {
    vtkNew<vtkDoubleArray> array;
    double * const         values = Allocate(*array, name, tuples, components);
    if (std::string_view(section) == "Points")
    {
      vtkNew<vtkPoints> points;
      points->SetData(array);
      m_Data.SetPoints(points);
    }
    else
    {
      FieldsOf(section)->AddArray(array);
    }
    return values;
  }

  std::int64_t *
  Wholes(const char * section, const char * name, std::uint64_t tuples, int components) override
  {
    vtkNew<vtkTypeInt64Array> array;
    FieldsOf(section)->AddArray(array);
    return reinterpret_cast<std::int64_t *>(Allocate(*array, name, tuples, components));
  }

  void
  Text(const char * name, const std::string & value) override
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    m_Data.GetFieldData()->AddArray(array);
  }

protected:
  CellBuffers<std::int32_t>
  NarrowCells(const char * section, std::uint64_t cells, std::uint64_t corners) override
  {
    return MakeCells<vtkTypeInt32Array, std::int32_t>(section, cells, corners);
  }
  CellBuffers<std::int64_t>
  WideCells(const char * section, std::uint64_t cells, std::uint64_t corners) override
  {
    return MakeCells<vtkTypeInt64Array, std::int64_t>(section, cells, corners);
  }

private:
  template <typename ArrayType, typename Index>
  CellBuffers<Index>
  MakeCells(const char * section, std::uint64_t cells, std::uint64_t corners)
  {
    vtkNew<ArrayType>        offsets;
    vtkNew<ArrayType>        points;
    const CellBuffers<Index> buffers{ reinterpret_cast<Index *>(Allocate(*offsets, "offsets", cells + 1)),
                                      reinterpret_cast<Index *>(Allocate(*points, "connectivity", corners)) };
    *buffers.offsets = 0;
    vtkNew<vtkCellArray> array;
    array->SetData(offsets.Get(), points.Get());
    const std::string_view kind = section;
    if (kind == "Verts")
    {
      m_Data.SetVerts(array);
    }
    else if (kind == "Lines")
    {
      m_Data.SetLines(array);
    }
    else
    {
      m_Data.SetPolys(array);
    }
    return buffers;
  }

  vtkFieldData *
  FieldsOf(const std::string_view section)
  {
    if (section == "PointData")
    {
      return m_Data.GetPointData();
    }
    return section == "CellData" ? m_Data.GetCellData() : m_Data.GetFieldData();
  }

  vtkPolyData & m_Data;
};

} // namespace

vtkSmartPointer<vtkPolyData>
MakePolyData(const MedialModel & model, bool keepEdges)
{
  auto         data = vtkSmartPointer<vtkPolyData>::New();
  PolyDataSink sink(*data);
  WriteParts(model, keepEdges, sink);
  return data;
}

} // namespace voxelcore
