#pragma once
// Several labels taken as one body, whose skeleton says which label each point is of.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Labels/LabelMap.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** The labels of a network, apart from their union that is worked on. */
class NetworkLabels
{
public:
  /** Takes the labels out of a scan, in whose place is then their union, label 1, called "network".
   *  \throws InputError, naming the scan `where`, when it has one label alone */
  NetworkLabels(std::vector<LabelShape> & labels, const std::string & where, std::vector<std::string> & notes);

  /** To be called with the union as it was edited, before it is worked on. `scan` is what was read: none has no
   *  border. */
  void
  Fit(const EditedLabel &             edited,
      const ImageGeometry &           geometry,
      const std::optional<VoxelBox> & scan,
      const SkeletonRequest &         request);

  const std::vector<LabelShape> &
  Labels() const
  {
    return m_Labels;
  }

  /** Makes a skeleton of the union that of the network, cut as asked for, and records it.
   *  \throws CertificateError */
  void
  Take(LabelOutcome &             outcome,
       const SkeletonRequest &    request,
       const CoreReport &         report,
       std::vector<std::string> & notes) const;

private:
  std::vector<LabelShape> m_Labels;
  VoxelShape              m_Shape; ///< their union as it was edited, up to the scan's border
};

} // namespace voxelcore
