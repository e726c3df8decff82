// The Delaunay tetrahedralization by CGAL, for comparison: a process of its own, as CGAL is GPL and not part of
// VoxelCore. usage: VoxelCoreCgalTask FILE.points [THREADS]    points: three int32 each; with THREADS in parallel under
// TBB. Prints the seconds of the call alone.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#  include <tbb/global_control.h>
#endif

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

template <class Tag>
using Triangulation =
  CGAL::Delaunay_triangulation_3<Kernel,
                                 CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                                                      CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
                                                                      Tag>>;

std::vector<Point>
ReadPoints(const char * path)
{
  std::ifstream               file(path, std::ios::binary);
  std::vector<Point>          points;
  std::array<std::int32_t, 3> point{};
  while (file.read(reinterpret_cast<char *>(point.data()), sizeof point))
  {
    points.emplace_back(point[0], point[1], point[2]);
  }
  return points;
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc < 2)
  {
    std::cerr << "usage: VoxelCoreCgalTask FILE.points [THREADS]\n";
    return 2;
  }
  const std::vector<Point> points = ReadPoints(argv[1]);
  if (points.empty())
  {
    std::cerr << "VoxelCoreCgalTask: no points in " << argv[1] << "\n";
    return 1;
  }
  const auto  start = std::chrono::steady_clock::now();
  std::size_t vertices = 0;
  if (argc == 2)
  {
    vertices = Triangulation<CGAL::Sequential_tag>(points.begin(), points.end()).number_of_vertices();
  }
  else
  {
#ifdef CGAL_LINKED_WITH_TBB
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, std::stoul(argv[2]));
    const CGAL::Bbox_3        box = CGAL::bbox_3(points.begin(), points.end());
    Triangulation<CGAL::Parallel_tag>::Lock_data_structure locks(box, 50);
    vertices = Triangulation<CGAL::Parallel_tag>(points.begin(), points.end(), &locks).number_of_vertices();
#else
    std::cerr << "VoxelCoreCgalTask: built without TBB\n";
    return 1;
#endif
  }
  const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (vertices != points.size())
  {
    std::cerr << "VoxelCoreCgalTask: " << vertices << " vertices of " << points.size() << " points\n";
    return 1;
  }
  std::cout << seconds << '\n';
  return 0;
}
