#pragma once
// Where a model's arrays come from: a .vtp file, or VTK's polydata in memory.

#include "voxelcore/Models/MedialModel.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace voxelcore
{

/** Arrays by section and name, as VtpArrays describes them. Functions throw UnfitFile for what is missing or of another
 *  type or size. */
class ModelSource
{
public:
  virtual ~ModelSource() = default;
  virtual std::uint64_t
  PieceCount(const std::string & attribute) const = 0;
  virtual bool
  Has(const std::string & section, const std::string & name) const = 0;
  virtual std::vector<double>
  ReadReals(const std::string & section, const std::string & name, int components) = 0;
  virtual std::vector<std::int64_t>
  ReadWholes(const std::string & section, const std::string & name, int components) = 0;
  virtual std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name) = 0;
  virtual std::string
  ReadText(const std::string & section, const std::string & name) = 0;
  /** What of the numbers read so far has lost digits, a clause such as "its points are in single precision"; empty for
   *  what was stored in full. */
  virtual std::string
  Rounded() const
  {
    return {};
  }

  template <typename Value>
  std::vector<Value>
  Read(const std::string & section, const std::string & name, int components = 1)
  {
    if constexpr (std::is_same_v<Value, double>)
    {
      return ReadReals(section, name, components);
    }
    else
    {
      return ReadWholes(section, name, components);
    }
  }
};

/** Opens a file (.vtk: legacy, else .vtp) and calls `read` with it. With Precision::Exact what has lost digits is
 *  refused. Returns what did (ModelSource::Rounded). `maker`: the command that writes such files. \throws InputError */
std::string
ReadFrom(const std::filesystem::path &              path,
         Precision                                  precision,
         const std::string &                        maker,
         const std::function<void(ModelSource &)> & read);

/** The model in a source's arrays, checked throughout. Only with `anywhere` may it lack the field SPACE.
 *  \throws UnfitFile */
MedialModel
ReadParts(ModelSource & source, bool anywhere = false);

} // namespace voxelcore
