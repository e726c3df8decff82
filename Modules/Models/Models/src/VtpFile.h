#pragma once
// The arrays of a .vtp file in the form WriteVtp gives it: appended data, little endian, 64-bit headers; in zlib's
// streams, or as they are, as former versions wrote them.
//
// The header must be well-formed, and every array must have the length that the file's counts give it, also those that
// nobody here asks for: what VTK could not open, or would read otherwise, is refused.
//
// VTK's own reader trusts the numbers in a file: one wrong bit in a count makes it write beyond its memory. What a user
// hands over may be damaged, so the few forms we write are read here, with every number checked against the file.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace voxelcore
{

/** Ends reading: the file is damaged or not one of ours; the reason begins in the middle of a sentence. */
struct UnfitFile
{
  std::string reason;
};

/** It may be whole, but it is not in the form that VtpFile reads. */
struct OtherForm : UnfitFile
{};

/** Throws UnfitFile when the condition does not hold. */
inline void
RequireFit(bool condition, const char * reason)
{
  if (!condition)
  {
    throw UnfitFile{ reason };
  }
}

/** All bytes of a file. \throws UnfitFile */
std::string
WholeFile(const std::filesystem::path & path);

/** Arrays by section ("FieldData", "PointData", "CellData", "Points", "Verts", "Lines", "Polys") and name. Every
 *  function throws UnfitFile when what it is asked for is missing or has another type or size. */
class VtpFile
{
public:
  explicit VtpFile(const std::filesystem::path & path);

  /** An attribute of the piece, such as NumberOfPoints. */
  std::uint64_t
  PieceCount(const std::string & attribute) const;

  bool
  Has(const std::string & section, const std::string & name) const
  {
    return m_Arrays.contains({ section, name });
  }

  /** All values of an array of Float64 (double) or Int64 (std::int64_t), tuple after tuple. */
  template <typename Value>
  std::vector<Value>
  Read(const std::string & section, const std::string & name, int components = 1);

  /** All values of an array of Int32 or Int64. */
  std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name);

  /** The one string of a string array. */
  std::string
  ReadText(const std::string & section, const std::string & name);

private:
  struct Array
  {
    std::string   type;
    std::uint64_t components;
    std::uint64_t tuples; ///< as said of a field array
    std::uint64_t offset; ///< from the beginning of the appended data
  };

  const Array &
  Find(const std::string & section, const std::string & name) const;
  void
  ParseHeader(const std::string & xml);
  void
  AddArray(const std::string & section, std::map<std::string, std::string> & attributes);
  void
  CheckArrays();
  /** Bytes from there on, of the appended data. */
  void
  ReadAt(std::uint64_t offset, char * to, std::uint64_t bytes);
  /** Goes to the values of an array; returns their bytes, unpacked. */
  std::uint64_t
  OpenBlock(const Array & array);
  /** All of the array that was opened last. */
  void
  ReadOpened(char * to);
  std::string
  ReadOpenedText(std::uint64_t bytes);
  template <typename Value>
  std::vector<Value>
  ReadBlock(const Array & array);

  std::ifstream                                        m_File;
  std::uint64_t                                        m_DataBegin = 0;
  std::uint64_t                                        m_DataEnd = 0;
  std::map<std::string, std::string>                   m_Piece;
  std::map<std::pair<std::string, std::string>, Array> m_Arrays;

  struct Stretch
  {
    std::uint64_t packed;
    std::uint64_t bytes;
  };

  bool                 m_IsPacked = false;
  std::uint64_t        m_Opened = 0; ///< where the first stretch of the array begins
  std::vector<Stretch> m_Stretches;
};

} // namespace voxelcore
