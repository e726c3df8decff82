#ifndef itkMedialComplexToMeshFilter_h
#define itkMedialComplexToMeshFilter_h

#include "itkDefaultStaticMeshTraits.h"
#include "itkLineCell.h"
#include "itkMedialComplexObject.h"
#include "itkMesh.h"
#include "itkMeshSource.h"
#include "itkPolyLineParametricPath.h"
#include "itkPolygonCell.h"
#include "itkVertexCell.h"

#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <vector>

namespace itk
{

/** A mesh in double precision; coordinates of ITK's usual Mesh<double, 3> are floats. */
using MedialMesh = Mesh<double, 3, DefaultStaticMeshTraits<double, 3, 3, double>>;

/** \class MedialComplexToMeshFilter
 * \brief The cores of a MedialComplexObject as one mesh, for ITK's filters and writers of meshes.
 *
 * Points are in LPS mm, their data are radii. Cells are isolated vertices, edges that bound no polygon, and polygons,
 * label after label; their data are labels.
 * \sa VoxelCoreFilter, LambdaPruningFilter
 * \ingroup VoxelCore
 */
template <typename TOutputMesh = MedialMesh>
class MedialComplexToMeshFilter : public MeshSource<TOutputMesh>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialComplexToMeshFilter);

  using Self = MedialComplexToMeshFilter;
  using Superclass = MeshSource<TOutputMesh>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using InputType = MedialComplexObject;
  using CellType = typename TOutputMesh::CellType;
  using PixelType = typename TOutputMesh::PixelType;

  static_assert(TOutputMesh::PointDimension == 3, "cores lie in space");

  itkNewMacro(Self);
  itkTypeMacro(MedialComplexToMeshFilter, MeshSource);

  using Superclass::SetInput;
  void
  SetInput(const InputType * cores)
  {
    // ProcessObject does not know constness, and does not change its inputs' data.
    this->SetNthInput(0, const_cast<InputType *>(cores));
  }
  const InputType *
  GetInput() const
  {
    return static_cast<const InputType *>(this->GetPrimaryInput());
  }

protected:
  MedialComplexToMeshFilter()
  {
    this->SetNumberOfRequiredInputs(1);
  }
  ~MedialComplexToMeshFilter() override = default;

  /** Cores have no regions, and a mesh takes none of what is known of them beforehand. */
  void
  GenerateInputRequestedRegion() override
  {}
  void
  GenerateOutputInformation() override
  {}

  void
  GenerateData() override
  {
    TOutputMesh & mesh = *this->GetOutput();
    mesh.Initialize();
    for (const auto & part : this->GetInput()->GetParts())
    {
      const auto & cells = part.core->core.core.cells;
      const auto & core = part.core->core.core;
      const auto   first = mesh.GetNumberOfPoints();
      const auto   label = static_cast<PixelType>(part.origin.label);
      for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
      {
        typename TOutputMesh::PointType point;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          point[axis] = static_cast<typename TOutputMesh::CoordRepType>(core.positions[vertex][axis]);
        }
        mesh.SetPoint(first + vertex, point);
        mesh.SetPointData(first + vertex, static_cast<PixelType>(core.radius[vertex]));
      }
      std::vector<bool> onEdge(cells.vertexCount, false);
      std::vector<bool> onFace(cells.edges.size(), false);
      for (const auto edge : cells.faceEdges)
      {
        onFace[edge] = true;
      }
      for (const auto & edge : cells.edges)
      {
        onEdge[edge[0]] = onEdge[edge[1]] = true;
      }
      for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
      {
        if (!onEdge[vertex])
        {
          this->Add(new VertexCell<CellType>, std::array{ first + vertex }, label);
        }
      }
      for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
      {
        if (!onFace[edge])
        {
          const auto & ends = cells.edges[edge];
          this->Add(new LineCell<CellType>, std::array{ first + ends[0], first + ends[1] }, label);
        }
      }
      for (std::size_t face = 0; face < cells.FaceCount(); ++face)
      {
        std::vector<IdentifierType> corners;
        for (const auto corner : cells.FaceVertices(face))
        {
          corners.push_back(first + corner);
        }
        this->Add(new PolygonCell<CellType>(static_cast<unsigned int>(corners.size())), corners, label);
      }
    }
  }

private:
  template <typename TCell, typename TPoints>
  void
  Add(TCell * cell, const TPoints & points, PixelType label)
  {
    TOutputMesh &                         mesh = *this->GetOutput();
    const auto                            identifier = mesh.GetNumberOfCells();
    typename TOutputMesh::CellAutoPointer owner;
    owner.TakeOwnership(cell);
    for (std::size_t point = 0; point < points.size(); ++point)
    {
      owner->SetPointId(static_cast<int>(point), points[point]);
    }
    mesh.SetCell(identifier, owner);
    mesh.SetCellData(identifier, label);
  }
};

/** A branch of a curve skeleton, for ITK's iterators and filters of paths. */
using MedialPath = PolyLineParametricPath<3>;

/** The branches of a curve skeleton, such as CertifiedSkeleton::skeleton.graph of a label of `image`, in their order.
 *
 * Vertices are continuous indices of the image that the labels were read from, as paths of ITK have them; its
 * TransformContinuousIndexToPhysicalPoint leads back to LPS mm. Vertex n of path b is point graph.Branch(b)[n], whose
 * radius is graph.radius. A closed branch ends at its first vertex. Points without a branch have no path. */
inline std::vector<MedialPath::Pointer>
PathsOfBranches(const voxelcore::SkeletonGraph & graph, const VoxelLatticeObject & image)
{
  std::vector<MedialPath::Pointer> paths;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    auto path = MedialPath::New();
    for (const auto point : graph.Branch(branch))
    {
      const auto             lattice = voxelcore::PhysicalToLattice(image.GetGeometry(), graph.positions[point]);
      MedialPath::VertexType vertex;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        vertex[axis] = static_cast<double>(image.GetStartIndex()[axis]) + lattice[axis] - 0.5;
      }
      path->AddVertex(vertex);
    }
    paths.push_back(path);
  }
  return paths;
}

} // namespace itk

#endif
