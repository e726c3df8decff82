#pragma once
// Messages that name an option of the command line, said with Python's keywords.

#include <string>

namespace voxelcore
{

/** Each option in `message` becomes the keyword argument that does the same: `--lambda 1.5mm` is lambda_='1.5mm'. An
 *  option that Python lacks is called the command line's. What stands between quotes as a whole command stays. */
std::string
InPythonWords(const std::string & message);

} // namespace voxelcore
