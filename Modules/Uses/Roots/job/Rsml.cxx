// Root System Markup Language: metadata, then scene > plant > root, nested.

#include "voxelcore/Models/TextFile.h"
#include "voxelcore/Models/XmlText.h"

#include "voxelcore/Roots/RootFiles.h"

#include <cmath>
#include <numeric>

namespace voxelcore
{

namespace
{

struct Definition
{
  const char * label;
  const char * type;
  const char * unit; ///< empty: none; "mm" stands for the unit of lengths
};

constexpr std::array<Definition, 6> kProperties{ { { "level", "integer", "" },
                                                   { "length", "real", "mm" },
                                                   { "mean-diameter", "real", "mm" },
                                                   { "emergence-angle", "real", "degree" },
                                                   { "parent-node", "integer", "" },
                                                   { "parent-position", "real", "mm" } } };

class RsmlWriter
{
public:
  RsmlWriter(const std::filesystem::path & path, const RootModel & model, const RsmlOptions & options)
    : m_File(path, 10)
    , m_Model(model)
    , m_Radii(SectionRadii(model.graph))
    , m_Children(model.roots.axes.size())
    , m_Ids(options.sequence ? options.sequence->ids : std::vector<std::int64_t>(model.roots.axes.size()))
  {
    if (!options.sequence)
    {
      std::iota(m_Ids.begin(), m_Ids.end(), 0);
    }
    for (ElementIndex axis = 0; axis < model.roots.axes.size(); ++axis)
    {
      if (model.roots.axes[axis].parent != kNoRoot)
      {
        m_Children[model.roots.axes[axis].parent].push_back(axis);
      }
    }
  }

  void
  Write(const RsmlOptions & options)
  {
    const std::string unit = m_Model.unit == SpatialUnit::Millimetres ? "mm" : "pixel";
    m_File << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<rsml xmlns:po=\"http://www.plantontology.org/xml-dtd/po.dtd\">\n  <metadata>\n"
              "    <version>1</version>\n    <unit>"
           << unit << "</unit>\n    <resolution>1</resolution>\n    <last-modified>" << options.lastModified
           << "</last-modified>\n    <software>" << XmlText(options.software)
           << "</software>\n    <user></user>\n    <file-key>" << XmlText(m_Model.name)
           << "</file-key>\n    <image>\n      <name>" << XmlText(m_Model.name) << "</name>\n";
    if (!options.sha256.empty())
    {
      m_File << "      <sha256>" << options.sha256 << "</sha256>\n";
    }
    m_File << "    </image>\n";
    if (options.sequence)
    {
      m_File << "    <time-sequence>\n      <label>" << XmlText(options.sequence->label) << "</label>\n      <index>"
             << options.sequence->index << "</index>\n      <unified>true</unified>\n    </time-sequence>\n";
    }
    m_File << "    <property-definitions>\n";
    for (const Definition & property : kProperties)
    {
      Define("property-definition", property, unit);
    }
    m_File << "    </property-definitions>\n    <function-definitions>\n";
    Define("function-definition", { "diameter", "real", "mm" }, unit);
    m_File << "    </function-definitions>\n  </metadata>\n  <scene>\n";
    for (ElementIndex axis = 0; axis < m_Model.roots.axes.size(); ++axis)
    {
      if (m_Model.roots.axes[axis].parent == kNoRoot)
      {
        m_File << "    <plant ID=\"plant-" << m_Ids[axis] << "\" label=\""
               << (m_Model.roots.axes[axis].loose ? "loose piece" : "plant") << "\">\n";
        WriteRoot(axis, 3);
        m_File << "    </plant>\n";
      }
    }
    m_File << "  </scene>\n</rsml>\n";
    m_File.Finish();
  }

private:
  void
  Define(const char * element, const Definition & what, const std::string & unit)
  {
    m_File << "      <" << element << ">\n        <label>" << what.label << "</label>\n        <type>" << what.type
           << "</type>\n";
    if (what.unit[0] != '\0')
    {
      m_File << "        <unit>" << (std::string_view(what.unit) == "mm" ? unit : std::string(what.unit))
             << "</unit>\n";
    }
    m_File << "      </" << element << ">\n";
  }

  void
  WriteRoot(ElementIndex number, int depth)
  {
    const RootAxis &   axis = m_Model.roots.axes[number];
    const RootRecord & record = m_Model.traits.roots[number];
    const std::string  indent(static_cast<std::size_t>(2 * depth), ' ');
    m_File << indent << "<root ID=\"root-" << m_Ids[number] << "\" label=\""
           << (axis.name.empty() ? (axis.level == 0 ? "stem " : "root ") + std::to_string(m_Ids[number])
                                 : XmlText(axis.name))
           << "\" po:accession=\"" << (axis.level == 0 ? "PO:0020127" : "PO:0020121") << "\">\n";
    m_File << indent << "  <properties>\n";
    Property(indent, "level", axis.level);
    Property(indent, "length", record.length);
    Property(indent, "mean-diameter", record.meanDiameter);
    if (axis.parent != kNoRoot)
    {
      if (std::isfinite(record.emergenceAngle))
      {
        Property(indent, "emergence-angle", record.emergenceAngle);
      }
      Property(indent, "parent-node", axis.parentPoint);
      Property(indent, "parent-position", record.alongParent);
    }
    m_File << indent << "  </properties>\n" << indent << "  <geometry>\n" << indent << "    <polyline>\n";
    for (const ElementIndex point : axis.points)
    {
      const auto & p = m_Model.graph.positions[point];
      m_File << indent << "      <point x=\"" << p[0] << "\" y=\"" << p[1] << "\" z=\"" << p[2] << "\"/>\n";
    }
    m_File << indent << "    </polyline>\n" << indent << "  </geometry>\n" << indent << "  <functions>\n";
    m_File << indent << "    <function name=\"diameter\" domain=\"polyline\">\n";
    for (const ElementIndex point : axis.points)
    {
      m_File << indent << "      <sample value=\"" << 2 * m_Radii[point] << "\"/>\n";
    }
    m_File << indent << "    </function>\n" << indent << "  </functions>\n";
    for (const ElementIndex child : m_Children[number])
    {
      WriteRoot(child, depth + 1);
    }
    m_File << indent << "</root>\n";
  }

  template <typename Value>
  void
  Property(const std::string & indent, const char * name, Value value)
  {
    m_File << indent << "    <" << name << ">" << value << "</" << name << ">\n";
  }

  TextFile                               m_File;
  const RootModel &                      m_Model;
  const std::vector<double> &            m_Radii;
  std::vector<std::vector<ElementIndex>> m_Children;
  std::vector<std::int64_t>              m_Ids;
};

} // namespace

void
WriteRsml(const std::filesystem::path & path, const RootModel & model, const RsmlOptions & options)
{
  RsmlWriter(path, model, options).Write(options);
}

} // namespace voxelcore
