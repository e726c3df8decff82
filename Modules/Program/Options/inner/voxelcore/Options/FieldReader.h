#pragma once
// Fields of options (ParameterFields.h) from the values given: a field's row in the table has its name, with dashes.

#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Formats/RawLayout.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Jobs/RefineStage.h"
#include "voxelcore/Labels/CropRange.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Masks/ShapeMedian.h"
#include "voxelcore/Masks/SliceHoles.h"
#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Report/ParameterFields.h"
#include "voxelcore/Shape/ShapeConnectivity.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace voxelcore
{

/** Fills each field its command has an option for. Counts are unsigned and begin at 1, places are signed and begin at
 *  0. \throws UsageError, naming the option, for a value without sense */
class FieldReader
{
public:
  explicit FieldReader(const ParameterReader & reader)
    : m_Reader(reader)
  {}

  template <typename T>
  void
  operator()(std::string_view field, T & value) const
  {
    std::string name(field);
    std::replace(name.begin(), name.end(), '_', '-');
    if (const Parameter * const row = m_Reader.Find(name))
    {
      Read(*row, value);
    }
  }

private:
  void
  Read(const Parameter & row, bool & value) const
  {
    value = m_Reader.IsSet(row.name);
  }

  void
  Read(const Parameter & row, std::string & value) const
  {
    value = m_Reader.Choice(row.name);
  }

  void
  Read(const Parameter & row, Connectivity & value) const
  {
    value = *ConnectivityNamed(m_Reader.Choice(row.name));
  }

  template <typename T>
  void
  Read(const Parameter & row, std::optional<T> & value) const
  {
    if (m_Reader.IsGiven(row.name) && !IsWord(row))
    {
      value = Given<T>(row);
    }
  }

  /** Of --cavities, which may be a number. */
  bool
  IsWord(const Parameter & row) const
  {
    return row.name == "cavities" && (m_Reader.Text(row.name) == "fill" || m_Reader.Text(row.name) == "keep");
  }

  template <typename T>
  T
  Given(const Parameter & row) const
  {
    if constexpr (std::is_integral_v<T>)
    {
      return row.kind == ParameterKind::Integer || row.name == "cavities"
               ? static_cast<T>(
                   m_Reader.Whole(row.name, std::is_unsigned_v<T> ? 1 : 0, std::numeric_limits<std::int64_t>::max()))
               : static_cast<T>(*m_Reader.FirstResolution());
    }
    else if constexpr (std::is_same_v<T, std::string>)
    {
      return m_Reader.Text(row.name);
    }
    else if constexpr (std::is_same_v<T, CropRange>)
    {
      return ParseCrop(m_Reader.Text(row.name));
    }
    else if constexpr (std::is_same_v<T, RawLayout>)
    {
      return ParseRawLayout(m_Reader.Text(row.name));
    }
    else if constexpr (std::is_same_v<T, GapWidth>)
    {
      try
      {
        return ParseGapWidth(m_Reader.Text(row.name));
      }
      catch (const UsageError & error)
      {
        throw UsageError(std::string(row.flags) + ": " + error.what());
      }
    }
    else if constexpr (std::is_same_v<T, VoxelChanges>)
    {
      return ReadVoxelChanges(m_Reader.File(row.name));
    }
    else if constexpr (std::is_same_v<T, MedianWidth>)
    {
      try
      {
        return ParseMedianWidth(m_Reader.Text(row.name));
      }
      catch (const UsageError &)
      {
        m_Reader.ThrowUsageError(row.name, "an odd number from 3 to 15");
      }
    }
    else if constexpr (std::is_same_v<T, SliceAxis>)
    {
      const auto axis = SliceAxisNamed(m_Reader.Text(row.name));
      if (!axis)
      {
        m_Reader.ThrowUsageError(row.name, "i, j or k");
      }
      return *axis;
    }
    else if constexpr (std::is_same_v<T, Vector3>)
    {
      return m_Reader.Spacing(row.name);
    }
    else
    {
      static_assert(std::is_same_v<T, std::pair<double, double>>);
      return m_Reader.Range(row.name);
    }
  }

  const ParameterReader & m_Reader;
};

/** What is read of a scan and how its shapes are edited: `reading`, `resolution`, `edits`. */
template <typename TOptions>
void
ReadScanFields(const ParameterReader & reader, TOptions & options)
{
  ReadOptions & reading = options.reading;
  VisitScanFields(options, FieldReader(reader));
  reading.labels = reader.Text("labels");
  reading.refuseGrey = !reader.IsGiven("labels");
  if (reading.labels.empty())
  {
    reader.ThrowUsageError("labels", "'all', or values or names separated by commas");
  }
  if ((reading.labels != "all" ? 1 : 0) + (reading.binary ? 1 : 0) + (reading.threshold ? 1 : 0) > 1)
  {
    throw UsageError("give only one of --labels, --binary and --threshold");
  }
  if (reader.Find("tree") != nullptr && reader.IsSet("tree"))
  {
    TopologyRequest & topology = options.edits.topology;
    if (topology.IsGiven())
    {
      throw UsageError("--tree is --pieces 1 --loops 0 --cavities 0; give either");
    }
    topology = { 1, 0, 0 };
    options.edits.simplify = options.edits.simplify ? options.edits.simplify : ParseGapWidth("3vox");
  }
  // Simplification joins as many of the pieces that touch as it is asked for.
  if (options.edits.simplify && !reader.IsGiven("connectivity") &&
      (options.edits.topology.pieces || !options.edits.topology.IsGiven()))
  {
    options.edits.connectivity = Connectivity::Six;
  }
  constexpr bool simplifiesAnyhow = requires
  {
    options.keepLoops;
  };
  if (!simplifiesAnyhow && options.edits.topology.IsGiven() && !options.edits.simplify)
  {
    throw UsageError("--pieces, --loops and --cavities need --simplify-topology, such as --simplify-topology 2vox");
  }
}

/** `--refine` and the scan with grey values that goes with it; `usual` is the surface where it is auto. */
RefineOptions
RefineFrom(const ParameterReader & reader, const std::string & usual = {});

/** The values given of options that have no field of their own, by the names reports have for them. */
inline std::map<std::string, std::string>
FurtherOptions(const ParameterReader & reader)
{
  std::map<std::string, std::string> further;
  for (const Parameter & parameter : reader.Rows())
  {
    if (parameter.recorded && reader.IsGiven(parameter.name))
    {
      further[WithUnderscores(parameter.name)] = reader.Text(parameter.name);
    }
  }
  return further;
}

} // namespace voxelcore
