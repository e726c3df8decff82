#include "BenchmarkTasks.h"

#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <chrono>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#ifdef VOXELCORE_HAS_TETGEN
#  include <tetgen.h>
#endif

namespace voxelcore::performance
{

namespace
{

void
WritePhantom(const std::string & kind, std::int32_t n, const std::string & folder)
{
  PhantomOptions options;
  options.kind = kind;
  options.size = { n, n, n };
  const VoxelShape  shape = MakePhantom(options);
  const std::string stem = folder + '/' + kind + '-' + std::to_string(n);

  std::ofstream scan(stem + ".nrrd", std::ios::binary);
  scan << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: " << n << ' ' << n << ' ' << n
       << "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n";
  std::string row(static_cast<std::size_t>(n), '\0');
  for (std::int32_t z = 0; z < n; ++z)
  {
    for (std::int32_t y = 0; y < n; ++y)
    {
      for (std::int32_t x = 0; x < n; ++x)
      {
        row[static_cast<std::size_t>(x)] = shape.Contains(x, y, z) ? 1 : 0;
      }
      scan.write(row.data(), n);
    }
  }

  const std::vector<LatticePoint> points = BoundaryVertices(shape);
  std::ofstream                   list(stem + ".points", std::ios::binary);
  list.write(reinterpret_cast<const char *>(points.data()),
             static_cast<std::streamsize>(points.size() * sizeof(LatticePoint)));
  if (!scan.flush() || !list.flush())
  {
    throw std::runtime_error("cannot write " + stem);
  }
  std::cout << points.size() << '\n';
}

void
TimeTetGen([[maybe_unused]] const std::string & path)
{
#ifdef VOXELCORE_HAS_TETGEN
  std::ifstream list(path, std::ios::binary | std::ios::ate);
  const auto    count = static_cast<std::size_t>(list.tellg()) / sizeof(LatticePoint);
  list.seekg(0);
  tetgenio input;
  input.numberofpoints = static_cast<int>(count);
  input.pointlist = new REAL[3 * count];
  for (std::size_t i = 0; i < count; ++i)
  {
    LatticePoint point{};
    list.read(reinterpret_cast<char *>(&point), sizeof point);
    input.pointlist[3 * i] = point.x;
    input.pointlist[3 * i + 1] = point.y;
    input.pointlist[3 * i + 2] = point.z;
  }
  if (!list)
  {
    throw std::runtime_error("cannot read " + path);
  }
  tetgenio   output;
  char       switches[] = "QznNFBJ"; // as the engine has them: all it needs of TetGen, and no more
  const auto start = std::chrono::steady_clock::now();
  tetrahedralize(switches, &input, &output);
  std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << '\n';
#else
  throw std::runtime_error("this build has no TetGen");
#endif
}

} // namespace

int
RunTask(int argc, char ** argv)
{
  const std::string task = argc > 2 ? argv[2] : "";
  try
  {
    if (task == "phantom" && argc == 6)
    {
      WritePhantom(argv[3], static_cast<std::int32_t>(std::stol(argv[4])), argv[5]);
      return 0;
    }
    if (task == "tetgen" && argc == 4)
    {
      TimeTetGen(argv[3]);
      return 0;
    }
    std::cerr << "unknown task\n";
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
  }
  return 1;
}

} // namespace voxelcore::performance
