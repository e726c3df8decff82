#include "CohortMeans.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace voxelcore
{

namespace
{

constexpr std::string_view kMeasure = "compare_";

/** The probability that |t| of so many degrees of freedom is t at most. */
double
StudentWithin(double t, std::size_t freedom)
{
  const auto   nu = static_cast<double>(freedom);
  const double cosine2 = nu / (nu + t * t);
  const double sine = t / std::sqrt(nu + t * t);
  const bool   isOdd = freedom % 2 == 1;
  double       term = isOdd ? std::sqrt(cosine2) : 1; // cos, or 1, and what each further one is multiplied by
  double       sum = freedom == 1 ? 0 : term;
  for (std::size_t power = isOdd ? 3 : 2; power + 2 <= freedom; power += 2)
  {
    const auto p = static_cast<double>(power);
    term *= cosine2 * (p - 1) / p;
    sum += term;
  }
  return isOdd ? 2 / std::numbers::pi * (std::atan2(t, std::sqrt(nu)) + sine * sum) : sine * sum;
}

} // namespace

double
StudentHalfWidth(std::size_t n)
{
  double low = 1;
  double high = 13; // of one degree of freedom it is 12.706
  for (int halvings = 0; halvings < 60; ++halvings)
  {
    const double middle = (low + high) / 2;
    (StudentWithin(middle, n - 1) < 0.95 ? low : high) = middle;
  }
  return low;
}

std::vector<Row>
MeansOfComparisons(const std::vector<Row> & labels)
{
  struct Measures
  {
    Row                                        name;
    std::vector<std::string>                   order;
    std::map<std::string, std::vector<double>> values;
  };
  std::map<std::int64_t, Measures> byLabel;
  for (const Row & row : labels)
  {
    Measures & measures =
      byLabel.emplace(row.at("label").get<std::int64_t>(), Measures{ row.at("name"), {}, {} }).first->second;
    for (const auto & [key, value] : row.items())
    {
      if (key.starts_with(kMeasure) && value.is_number())
      {
        auto & values = measures.values[key];
        if (values.empty())
        {
          measures.order.push_back(key);
        }
        values.push_back(value.get<double>());
      }
    }
  }
  std::vector<Row> rows;
  for (auto & [label, measures] : byLabel)
  {
    for (const std::string & key : measures.order)
    {
      std::vector<double> & values = measures.values[key];
      ranges::sort(values); // sums do not depend on the order of cases
      const auto n = static_cast<double>(values.size());
      double     sum = 0;
      double     squares = 0;
      for (const double value : values)
      {
        sum += value;
      }
      const double mean = sum / n;
      for (const double value : values)
      {
        squares += (value - mean) * (value - mean);
      }
      Row row;
      row["label"] = label;
      row["name"] = measures.name;
      row["measure"] = key.substr(kMeasure.size());
      row["cases"] = values.size();
      row["mean"] = mean;
      if (values.size() > 1)
      {
        const double sd = std::sqrt(squares / (n - 1));
        const double half = StudentHalfWidth(values.size()) * sd / std::sqrt(n);
        row["ci95_low"] = mean - half;
        row["ci95_high"] = mean + half;
        row["sd"] = sd;
      }
      row["median"] = Median(values);
      row["min"] = values.front();
      row["max"] = values.back();
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

} // namespace voxelcore
