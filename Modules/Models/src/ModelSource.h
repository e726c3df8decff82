#pragma once
// Where a model's arrays come from: a .vtp file, or VTK's polydata in memory.

#include "voxelcore/MedialModel.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace voxelcore
{

/** Arrays by section and name, as VtpFile describes them. Functions throw UnfitFile for what is missing or of another
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

/** The model in a source's arrays, checked throughout. Only with `anywhere` may it lack the field SPACE.
 *  \throws UnfitFile */
MedialModel
ReadParts(ModelSource & source, bool anywhere = false);

} // namespace voxelcore
