#include "vtkVoxelCoreFilter.h"

#include "vtkFilterWork.h"
#include "voxelcore/Certified.h"
#include "voxelcore/CoreProvenance.h"
#include "voxelcore/ModelPolyData.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

vtkStandardNewMacro(vtkVoxelCoreFilter);

vtkVoxelCoreFilter::vtkVoxelCoreFilter() = default;
vtkVoxelCoreFilter::~vtkVoxelCoreFilter() = default;

namespace
{

/** Where the image lies, moved by `matrix` where there is one. */
voxelcore::ImageGeometry
GeometryOf(vtkImageData & image, vtkMatrix4x4 * matrix)
{
  voxelcore::ImageGeometry geometry;
  int                      extent[6];
  image.GetExtent(extent);
  double first[4] = { 0, 0, 0, 1 };
  image.TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first);
  for (std::size_t a = 0; a < 3; ++a)
  {
    geometry.size[a] = image.GetDimensions()[a];
    geometry.spacing[a] = image.GetSpacing()[a];
  }
  std::copy_n(image.GetDirectionMatrix()->GetData(), 9, geometry.direction.begin());
  if (matrix != nullptr)
  {
    if (matrix->GetElement(3, 0) != 0 || matrix->GetElement(3, 1) != 0 || matrix->GetElement(3, 2) != 0 ||
        matrix->GetElement(3, 3) != 1)
    {
      throw voxelcore::InputError("the last row of the matrix must be 0 0 0 1");
    }
    matrix->MultiplyPoint(first, first);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double way[4] = { 0, 0, 0, 0 };
      for (std::size_t row = 0; row < 3; ++row)
      {
        way[row] = geometry.direction[3 * row + axis];
      }
      matrix->MultiplyPoint(way, way);
      // The matrix may hold lengths, too: NIfTI's sform does.
      const double length = std::hypot(way[0], way[1], way[2]);
      geometry.spacing[axis] *= length;
      for (std::size_t row = 0; row < 3; ++row)
      {
        geometry.direction[3 * row + axis] = way[row] / length;
      }
    }
  }
  std::copy_n(first, 3, geometry.origin.begin());
  constexpr double kSkewDegrees = 0.0057; // axes orthonormal within 1e-4, as for files
  if (!(voxelcore::OrthonormalityDeviationDegrees(geometry) <= kSkewDegrees))
  {
    throw voxelcore::InputError("the axes of the image are not orthonormal");
  }
  return geometry;
}

/** The labels in an image's values, which lie along i, then j, then k. */
template <typename Value>
class LabelShapes
{
public:
  LabelShapes(const Value * values, const std::array<std::int64_t, 3> & size, std::int64_t wanted)
    : m_Values(values)
    , m_Size{ static_cast<std::int32_t>(size[0]),
              static_cast<std::int32_t>(size[1]),
              static_cast<std::int32_t>(size[2]) }
    , m_Wanted(wanted)
  {}

  /** The shape of each label asked for, in its tight box. */
  std::map<std::int64_t, voxelcore::VoxelShape>
  Make() const
  {
    // First the boxes, so that many labels in a large image need no more than their own space.
    struct Box
    {
      std::array<std::int32_t, 3> lower;
      std::array<std::int32_t, 3> upper;
    };
    std::map<std::int64_t, Box> boxes;
    ForEachRun([&boxes](std::int64_t label, const std::array<std::int32_t, 3> & from, std::int32_t to) {
      Box & box = boxes.try_emplace(label, Box{ from, from }).first->second;
      for (std::size_t a = 0; a < 3; ++a)
      {
        box.lower[a] = std::min(box.lower[a], from[a]);
        box.upper[a] = std::max(box.upper[a], a == 0 ? to : from[a]);
      }
    });
    std::map<std::int64_t, voxelcore::VoxelShape> shapes;
    for (const auto & [label, box] : boxes)
    {
      voxelcore::VoxelBox whole{ box.lower, {} };
      for (std::size_t a = 0; a < 3; ++a)
      {
        whole.size[a] = box.upper[a] - box.lower[a] + 1;
      }
      shapes.emplace(label, whole);
    }
    ForEachRun([&shapes](std::int64_t label, const std::array<std::int32_t, 3> & from, std::int32_t to) {
      voxelcore::VoxelShape & shape = shapes.at(label);
      for (std::int32_t i = from[0]; i <= to; ++i)
      {
        shape.Insert(i, from[1], from[2]);
      }
    });
    return shapes;
  }

private:
  /** Calls function(label, first voxel, last i) for voxels of one label in a row. */
  template <typename Function>
  void
  ForEachRun(const Function & function) const
  {
    const Value * row = m_Values;
    for (std::int32_t k = 0; k < m_Size[2]; ++k)
    {
      for (std::int32_t j = 0; j < m_Size[1]; ++j, row += m_Size[0])
      {
        for (std::int32_t i = 0; i < m_Size[0];)
        {
          const std::int32_t first = i;
          while (++i < m_Size[0] && row[i] == row[first])
          {}
          const std::int64_t label = row[first] == Value{ 0 } ? 0 : LabelOf(row[first]);
          if (label != 0 && (m_Wanted == 0 || label == m_Wanted))
          {
            function(label, { first, j, k }, i - 1);
          }
        }
      }
    }
  }

  static std::int64_t
  LabelOf(Value value)
  {
    bool whole = value > Value{ 0 };
    if constexpr (std::is_floating_point_v<Value>)
    {
      constexpr double largest = 9007199254740992; // 2^53: above it reals are no longer all whole numbers
      whole = whole && value <= static_cast<Value>(largest) && std::floor(value) == value;
    }
    else if constexpr (sizeof(Value) == sizeof(std::int64_t))
    {
      whole = whole && std::in_range<std::int64_t>(value);
    }
    if (!whole)
    {
      throw voxelcore::InputError("the image holds a value that is no label: labels are whole numbers from 0");
    }
    return static_cast<std::int64_t>(value);
  }

  const Value *               m_Values;
  std::array<std::int32_t, 3> m_Size;
  std::int64_t                m_Wanted;
};

std::map<std::int64_t, voxelcore::VoxelShape>
ShapesOf(vtkDataArray & values, const std::array<std::int64_t, 3> & size, std::int64_t wanted)
{
  switch (values.GetDataType())
  {
    vtkTemplateMacro(
      return LabelShapes<VTK_TT>(static_cast<const VTK_TT *>(values.GetVoidPointer(0)), size, wanted).Make());
    default:
      throw voxelcore::InputError("the image's values are no numbers");
  }
}

} // namespace

void
vtkVoxelCoreFilter::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Label: " << this->Label << "\n";
  os << indent << "ImageIsInLPS: " << (this->ImageIsInLPS ? "On" : "Off") << "\n";
  os << indent << "ImageToLPSMatrix:" << (this->ImageToLPS ? "\n" : " (none)\n");
  if (this->ImageToLPS)
  {
    this->ImageToLPS->PrintSelf(os, indent.GetNextIndent());
  }
}

vtkMatrix4x4 *
vtkVoxelCoreFilter::GetImageToLPSMatrix()
{
  return this->ImageToLPS;
}

void
vtkVoxelCoreFilter::SetImageToLPSMatrix(vtkMatrix4x4 * matrix)
{
  vtkSmartPointer<vtkMatrix4x4> copy;
  if (matrix != nullptr)
  {
    copy = vtkSmartPointer<vtkMatrix4x4>::New();
    copy->DeepCopy(matrix);
  }
  const bool same = copy && this->ImageToLPS
                      ? std::equal(copy->GetData(), copy->GetData() + 16, this->ImageToLPS->GetData())
                      : !copy && !this->ImageToLPS;
  if (!same)
  {
    this->ImageToLPS = copy;
    this->Modified();
  }
}

void
vtkVoxelCoreFilter::SetImageToRASMatrix(vtkMatrix4x4 * matrix)
{
  if (matrix == nullptr)
  {
    this->SetImageToLPSMatrix(nullptr);
    return;
  }
  vtkNew<vtkMatrix4x4> turned;
  turned->DeepCopy(matrix);
  for (int column = 0; column < 4; ++column)
  {
    turned->SetElement(0, column, -matrix->GetElement(0, column));
    turned->SetElement(1, column, -matrix->GetElement(1, column));
  }
  this->SetImageToLPSMatrix(turned);
}

int
vtkVoxelCoreFilter::FillInputPortInformation(int, vtkInformation * information)
{
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int
vtkVoxelCoreFilter::RequestUpdateExtent(vtkInformation *, vtkInformationVector ** inputs, vtkInformationVector *)
{
  vtkInformation * const input = inputs[0]->GetInformationObject(0); // a core needs all of the image
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
             input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
             6);
  return 1;
}

int
vtkVoxelCoreFilter::RequestData(vtkInformation *, vtkInformationVector ** inputs, vtkInformationVector * outputs)
{
  vtkImageData * const image = vtkImageData::GetData(inputs[0]);
  const auto           setError = [this](unsigned long code) { this->SetErrorCode(code); };
  return vtkFilterWork(this, setError, vtkPolyData::GetData(outputs), [&] {
    vtkDataArray * const values = image->GetPointData()->GetScalars();
    if (values == nullptr || values->GetNumberOfComponents() != 1 ||
        values->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      throw voxelcore::InputError("the input needs point scalars of one component");
    }
    const voxelcore::ImageGeometry geometry = GeometryOf(*image, this->ImageToLPS);
    auto                           shapes = ShapesOf(*values, geometry.size, this->Label);
    if (shapes.empty())
    {
      throw voxelcore::InputError(this->Label == 0
                                    ? "the image holds nothing but background"
                                    : "label " + std::to_string(this->Label) + " does not occur in the image");
    }
    voxelcore::MedialModel model;
    model.inLps = this->ImageToLPS || this->ImageIsInLPS || !image->GetDirectionMatrix()->IsIdentity();
    std::vector<voxelcore::CoreOrigin>  origins;
    std::vector<voxelcore::CorePruning> prunings;
    const double                        share = 1 / static_cast<double>(shapes.size());
    double                              before = 0;
    for (auto & [label, shape] : shapes)
    {
      const std::string           name = "label-" + std::to_string(label);
      const std::uint64_t         voxels = shape.CountVoxels();
      voxelcore::CertifiedRequest request;
      request.name = "label " + std::to_string(label);
      request.lambdas = { voxelcore::Lambda() }; // the whole core
      voxelcore::CertifiedResult result = voxelcore::ComputeCertified(std::move(shape),
                                                                      geometry,
                                                                      request,
                                                                      vtkForwardProgress(this, before, before + share));
      model.parts.push_back(std::move(result.cores.front().core));
      model.parts.back().label = label;
      origins.push_back(voxelcore::OriginOf(result, label, name, voxels));
      prunings.push_back({ "0", 0, result.whole });
      before += share;
    }
    voxelcore::ReportProgress(vtkForwardProgress(this, 0, 1), "done", 1);
    model.provenance = voxelcore::CoreProvenanceJson(geometry, origins, prunings, true);
    return voxelcore::MakePolyData(model, true);
  });
}
