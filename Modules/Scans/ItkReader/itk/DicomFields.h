#pragma once
// Fields of a DICOM data set as values. What is not there, or makes no sense, is nothing.

#include "voxelcore/Lattice/Vectors.h"

#include <gdcmDataSet.h>
#include <gdcmFile.h>
#include <gdcmSequenceOfItems.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore::itkreader
{

/** The text of a field without the blanks around it; empty where there is none. */
std::string
FieldText(const gdcm::DataSet & set, const gdcm::Tag & tag);

/** The text of a field as UTF-8, by the file's Specific Character Set; letters of one that is not known are "?". */
std::string
FieldName(const gdcm::DataSet & set, const gdcm::Tag & tag, const std::string & characterSet);

/** The numbers of a field of decimal or whole numbers as text. */
std::optional<std::vector<double>>
FieldReals(const gdcm::DataSet & set, const gdcm::Tag & tag);
std::optional<double>
FieldReal(const gdcm::DataSet & set, const gdcm::Tag & tag);
std::optional<Vector3>
FieldVector(const gdcm::DataSet & set, const gdcm::Tag & tag);

/** The numbers of a field of 16-bit whole numbers. */
std::vector<std::uint16_t>
FieldShorts(const gdcm::DataSet & set, const gdcm::Tag & tag);
std::optional<std::uint16_t>
FieldShort(const gdcm::DataSet & set, const gdcm::Tag & tag);

/** A sequence; null where there is none. */
gdcm::SmartPointer<gdcm::SequenceOfItems>
FieldSequence(const gdcm::DataSet & set, const gdcm::Tag & tag);
/** The first item of a sequence. A copy: GDCM may parse a sequence anew for each who asks. */
std::optional<gdcm::DataSet>
FirstItem(const gdcm::DataSet & set, const gdcm::Tag & tag);

/** A field as it is stored; empty where there is none. */
std::string_view
FieldBytes(const gdcm::DataSet & set, const gdcm::Tag & tag);

} // namespace voxelcore::itkreader
