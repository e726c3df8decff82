#include "EvaluationRecords.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace voxelcore::evaluation
{
namespace
{

constexpr const char * kEnd = "end of group";

std::string
Line(const Record & record)
{
  char        number[40];
  std::string line = record.body + '\t' + (record.thick ? "1:1:2.5" : "1:1:1");
  std::snprintf(number, sizeof(number), "\t%g", record.spacing);
  line += number + ('\t' + std::to_string(record.seed)) + '\t' + record.method;
  for (const ScoreColumn & column : ScoreColumns())
  {
    std::snprintf(number, sizeof(number), "\t%.17g", record.scores.*column.value);
    line += number;
  }
  return line + '\n';
}

Record
ReadLine(const std::string & line)
{
  std::istringstream stream(line);
  const auto         next = [&stream] {
    std::string field;
    std::getline(stream, field, '\t');
    return field;
  };
  Record record;
  record.body = next();
  record.thick = next() != "1:1:1";
  record.spacing = std::stod(next());
  record.seed = std::stoull(next());
  record.method = next();
  for (const ScoreColumn & column : ScoreColumns())
  {
    record.scores.*column.value = std::stod(next());
  }
  return record;
}

// Of each column the mean or the worst.
Scores
Summary(const std::vector<Scores> & samples)
{
  Scores sum;
  for (const ScoreColumn & column : ScoreColumns())
  {
    for (const Scores & sample : samples)
    {
      sum.*column.value = column.worst ? std::max(sum.*column.value, sample.*column.value)
                                       : sum.*column.value + sample.*column.value / static_cast<double>(samples.size());
    }
  }
  return sum;
}

template <typename Key>
std::vector<std::pair<std::string, std::vector<Scores>>>
Grouped(const std::vector<Record> & records, const Key & key)
{
  std::vector<std::pair<std::string, std::vector<Scores>>> groups; // in the order met
  for (const Record & record : records)
  {
    const std::string name = key(record);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto & one) { return one.first == name; });
    if (group == groups.end())
    {
      group = groups.insert(groups.end(), { name, {} });
    }
    group->second.push_back(record.scores);
  }
  return groups;
}

} // namespace

KeptRecords::KeptRecords(std::string path)
  : m_Path(std::move(path))
{
  std::ifstream       file(m_Path);
  std::string         line;
  std::vector<Record> records;
  std::string         key;
  while (!m_Path.empty() && std::getline(file, line))
  {
    if (line.rfind("# ", 0) == 0)
    {
      key = line.substr(2);
      records.clear();
    }
    else if (line == kEnd)
    {
      m_Groups[key] = std::move(records);
      records.clear();
    }
    else if (std::count(line.begin(), line.end(), '\t') == 4 + static_cast<std::ptrdiff_t>(ScoreColumns().size()))
    {
      records.push_back(ReadLine(line));
    }
  }
}

void
KeptRecords::Add(const std::string & key, std::vector<Record> records)
{
  if (!m_Path.empty())
  {
    std::ofstream file(m_Path, std::ios::app);
    file << "\n# " << key << '\n';
    for (const Record & record : records)
    {
      file << Line(record);
    }
    file << kEnd << std::endl;
    if (!file)
    {
      throw std::runtime_error(m_Path + ": cannot be written");
    }
  }
  m_Groups[key] = std::move(records);
}

void
PrintTable(const std::string & title, const std::vector<Record> & records)
{
  if (records.empty())
  {
    return;
  }
  std::printf("\n%s\n\n|", title.c_str());
  for (const ScoreColumn & column : ScoreColumns())
  {
    std::printf(" | %s", column.name);
  }
  std::printf(" |\n|---|");
  for (std::size_t i = 0; i < ScoreColumns().size(); ++i)
  {
    std::printf("---|");
  }
  for (const auto & [method, samples] : Grouped(records, [](const Record & record) { return record.method; }))
  {
    const Scores scores = Summary(samples);
    std::printf("\n| %s |", method.c_str());
    for (const ScoreColumn & column : ScoreColumns())
    {
      std::printf(" %.*f |", column.value == &Scores::seconds ? 3 : 2, scores.*column.value);
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

void
PrintWorst(const std::vector<Record> & records)
{
  std::printf("\nby body, mean or worst, the three highest each\n");
  for (const auto & [method, ignored] : Grouped(records, [](const Record & record) { return record.method; }))
  {
    std::vector<Record> own;
    std::copy_if(records.begin(), records.end(), std::back_inserter(own), [name = method](const Record & record) {
      return record.method == name;
    });
    auto bodies = Grouped(own, [](const Record & r) { return r.body + (r.thick ? " 1:1:2.5" : " 1:1:1"); });
    for (auto & [body, samples] : bodies)
    {
      samples = { Summary(samples) };
    }
    std::printf("\n%s\n", method.c_str());
    for (const ScoreColumn & column : ScoreColumns())
    {
      std::sort(bodies.begin(), bodies.end(), [&](const auto & a, const auto & b) {
        return a.second[0].*column.value > b.second[0].*column.value;
      });
      std::printf("  %-14s", column.name);
      for (std::size_t i = 0; i < std::min<std::size_t>(3, bodies.size()); ++i)
      {
        std::printf("  %s %.2f", bodies[i].first.c_str(), bodies[i].second[0].*column.value);
      }
      std::printf("\n");
    }
  }
}

} // namespace voxelcore::evaluation
