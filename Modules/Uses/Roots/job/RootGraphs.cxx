// Roots as graphs for other programs: SWC and GraphML.

#include "voxelcore/Models/TextFile.h"
#include "voxelcore/Models/XmlText.h"

#include "voxelcore/Roots/RootFiles.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr int kFirstType = 5; // lower ones mean parts of neurons

/** Whether a lateral begins at a point of its parent, so that this need not be written twice. */
bool
SharesBase(const RootHierarchy & roots, const RootAxis & axis)
{
  return axis.parent != kNoRoot && roots.axes[axis.parent].points[axis.parentPoint] == axis.points.front();
}

} // namespace

void
WriteRootSwc(const std::filesystem::path & path, const RootModel & model)
{
  const bool                              inVoxels = model.unit == SpatialUnit::Voxels;
  const double                            scale = inVoxels ? 1 : 1000;
  const std::vector<double>               radii = SectionRadii(model.graph);
  const std::vector<RootAxis> &           axes = model.roots.axes;
  TextFile                                file(path, 9);
  std::vector<std::vector<std::uint64_t>> ids(axes.size());
  std::uint64_t                           next = 1;
  file << "# VoxelCore roots\n# " << (inVoxels ? "voxels" : "micrometres")
       << ", LPS axes; radii of round cross-sections; the type is " << kFirstType << " and the level\n";
  for (std::size_t number = 0; number < axes.size(); ++number)
  {
    const RootAxis & axis = axes[number];
    file << "# root " << number << " level " << axis.level;
    if (axis.parent != kNoRoot)
    {
      file << " parent " << axis.parent;
    }
    file << (axis.loose ? " loose" : "") << "\n";
    const bool    shares = SharesBase(model.roots, axis);
    std::uint64_t parent = axis.parent == kNoRoot ? 0 : ids[axis.parent][axis.parentPoint];
    for (std::size_t i = 0; i < axis.points.size(); ++i)
    {
      if (i > 0 || !shares)
      {
        const ElementIndex point = axis.points[i];
        file << next << " " << kFirstType + axis.level;
        for (const double coordinate : model.graph.positions[point])
        {
          file << " " << scale * coordinate;
        }
        file << " " << scale * radii[point] << " ";
        if (parent == 0)
        {
          file << "-1\n";
        }
        else
        {
          file << parent << "\n";
        }
        parent = next++;
      }
      ids[number].push_back(parent);
    }
  }
  file.Finish();
}

void
WriteRootGraphMl(const std::filesystem::path & path, const RootModel & model)
{
  const std::vector<double>          radii = SectionRadii(model.graph);
  const std::vector<RootAxis> &      axes = model.roots.axes;
  std::vector<std::set<std::size_t>> stops(axes.size()); // points of each root at which there is a node
  for (std::size_t number = 0; number < axes.size(); ++number)
  {
    const RootAxis & axis = axes[number];
    stops[number].insert(axis.points.size() - 1);
    if (!SharesBase(model.roots, axis))
    {
      stops[number].insert(0);
    }
    if (axis.parent != kNoRoot)
    {
      stops[axis.parent].insert(axis.parentPoint);
    }
  }
  TextFile file(path, 9);
  file << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  const auto key = [&](const char * id, const char * of, const char * type) {
    file << "  <key id=\"" << id << "\" for=\"" << of << "\" attr.name=\"" << id << "\" attr.type=\"" << type
         << "\"/>\n";
  };
  for (const char * name : { "x", "y", "z", "radius" })
  {
    key(name, "node", "double");
  }
  key("kind", "node", "string");
  for (const char * name : { "root", "level", "parent" })
  {
    key(name, "edge", "int");
  }
  key("name", "edge", "string");
  for (const char * name : { "length", "mean_radius" })
  {
    key(name, "edge", "double");
  }
  file << "  <graph id=\"roots\" edgedefault=\"directed\">\n";
  const auto data = [&](const char * name, auto value) {
    file << "<data key=\"" << name << "\">" << value << "</data>";
  };
  // A lateral that begins on its parent's line has its parent's node there.
  std::vector<std::vector<std::string>> ids(axes.size());
  for (std::size_t number = 0; number < axes.size(); ++number)
  {
    const RootAxis & axis = axes[number];
    for (std::size_t i = 0; i < axis.points.size(); ++i)
    {
      const bool isShared = i == 0 && SharesBase(model.roots, axis);
      ids[number].push_back(isShared ? ids[axis.parent][axis.parentPoint]
                                     : "r" + std::to_string(number) + "p" + std::to_string(i));
      if (!isShared && stops[number].contains(i))
      {
        const ElementIndex point = axis.points[i];
        file << "    <node id=\"" << ids[number][i] << "\">";
        data("x", model.graph.positions[point][0]);
        data("y", model.graph.positions[point][1]);
        data("z", model.graph.positions[point][2]);
        data("radius", radii[point]);
        const bool isTip = i + 1 == axis.points.size();
        data("kind", std::string_view(isTip ? axis.endsAtContact ? "contact" : "tip" : i == 0 ? "base" : "junction"));
        file << "</node>\n";
      }
    }
  }
  for (std::size_t number = 0; number < axes.size(); ++number)
  {
    const RootAxis & axis = axes[number];
    const auto       edge = [&](const std::string & from, const std::string & to, double length, double mean) {
      file << "    <edge source=\"" << from << "\" target=\"" << to << "\">";
      data("root", number);
      data("level", axis.level);
      if (axis.parent != kNoRoot)
      {
        data("parent", axis.parent);
      }
      if (!axis.name.empty())
      {
        data("name", std::string_view(XmlText(axis.name)));
      }
      data("length", length);
      data("mean_radius", mean);
      file << "</edge>\n";
    };
    if (axis.parent != kNoRoot && !SharesBase(model.roots, axis))
    {
      const ElementIndex from = axes[axis.parent].points[axis.parentPoint];
      const ElementIndex to = axis.points.front();
      edge(ids[axis.parent][axis.parentPoint],
           ids[number].front(),
           Distance(model.graph.positions[from], model.graph.positions[to]),
           radii[to]);
    }
    std::size_t last = 0;
    double      length = 0;
    double      weighted = 0;
    for (std::size_t i = 1; i < axis.points.size(); ++i)
    {
      const double step = Distance(model.graph.positions[axis.points[i - 1]], model.graph.positions[axis.points[i]]);
      length += step;
      weighted += step * (radii[axis.points[i - 1]] + radii[axis.points[i]]) / 2;
      if (stops[number].contains(i))
      {
        edge(ids[number][last], ids[number][i], length, length > 0 ? weighted / length : radii[axis.points[i]]);
        last = i;
        length = 0;
        weighted = 0;
      }
    }
  }
  file << "  </graph>\n</graphml>\n";
  file.Finish();
}

} // namespace voxelcore
