// Functions whose last bits the C library here has otherwise than that of Debian's programs: rounded from more digits,
// which those are but for one value in hundreds (measured on Windows: 8 to 53 of 20,000).

#include <cmath>

extern "C"
{
#define VOXELCORE_ROUNDED(name)             \
  double name(double x)                     \
  {                                         \
    return static_cast<double>(name##l(x)); \
  }
  VOXELCORE_ROUNDED(sin)
  VOXELCORE_ROUNDED(cos)
  VOXELCORE_ROUNDED(tan)
  VOXELCORE_ROUNDED(asin)
  VOXELCORE_ROUNDED(acos)
#undef VOXELCORE_ROUNDED
  double
  atan2(double y, double x)
  {
    return static_cast<double>(atan2l(y, x));
  }
}
