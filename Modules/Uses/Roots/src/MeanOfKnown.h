#pragma once
// A mean that passes over what is not known.

#include <cmath>
#include <limits>

namespace voxelcore
{

/** The mean of what is known. */
class MeanOfKnown
{
public:
  void
  Add(double value, double weight = 1)
  {
    if (std::isfinite(value))
    {
      m_Sum += weight * value;
      m_Weight += weight;
    }
  }
  double
  Value() const
  {
    return m_Weight > 0 ? m_Sum / m_Weight : std::numeric_limits<double>::quiet_NaN();
  }

private:
  double m_Sum = 0;
  double m_Weight = 0;
};

} // namespace voxelcore
