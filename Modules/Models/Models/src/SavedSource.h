#pragma once
// Files that another program saved: the arrays of .vtp in any encoding and of legacy .vtk, in whatever type they are
// now.

#include "LegacyPolyData.h"
#include "ModelSource.h"
#include "VtpFile.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** Numbers of any type as the model's; whole numbers stored as real ones are taken where they are whole. What lost
 *  digits on the way is remembered. */
class SavedSource : public ModelSource
{
public:
  std::string
  Rounded() const override;

protected:
  /** A look at what was read; `name` as users know it. */
  void
  Remember(const std::string & name, NumberType type, bool isText, const std::vector<double> & values);
  static std::vector<std::int64_t>
  AsWholes(const std::vector<double> & values);
  [[noreturn]] static void
  Missing(const std::string & section, const std::string & name);

private:
  std::vector<std::string> m_Single; ///< names of what is in single precision
  std::vector<std::string> m_Short;  ///< of what is text of few digits
};

/** .vtp, as we write it or VTK, ParaView and Slicer. */
class XmlSource : public SavedSource
{
public:
  /** \throws UnfitFile */
  explicit XmlSource(const std::filesystem::path & path);
  std::uint64_t
  PieceCount(const std::string & attribute) const override;
  bool
  Has(const std::string & section, const std::string & name) const override;
  std::vector<double>
  ReadReals(const std::string & section, const std::string & name, int components) override;
  std::vector<std::int64_t>
  ReadWholes(const std::string & section, const std::string & name, int components) override;
  std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name) override;
  std::string
  ReadText(const std::string & section, const std::string & name) override;

private:
  const VtpArrays &
  ArraysOf(const std::string & section) const;
  const VtpArray &
  Find(const std::string & section, const std::string & name, int components) const;

  VtpFile m_File;
};

/** Legacy .vtk, text or binary, of every version. */
class LegacySource : public SavedSource
{
public:
  /** \throws UnfitFile */
  explicit LegacySource(std::string bytes);
  std::uint64_t
  PieceCount(const std::string & attribute) const override;
  bool
  Has(const std::string & section, const std::string & name) const override;
  std::vector<double>
  ReadReals(const std::string & section, const std::string & name, int components) override;
  std::vector<std::int64_t>
  ReadWholes(const std::string & section, const std::string & name, int components) override;
  std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name) override;
  std::string
  ReadText(const std::string & section, const std::string & name) override;

private:
  const LegacyArray &
  Find(const std::string & section, const std::string & name, int components) const;
  const LegacyCells &
  Cells(const std::string & section) const;

  std::string    m_Bytes;
  LegacyPolyData m_Data;
};

} // namespace voxelcore
