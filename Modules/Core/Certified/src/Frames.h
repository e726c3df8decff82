#pragma once
// Requests and results on their way between a scan and the frame in which a body is computed (BodyFrame.h).

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Shape/BodyFrame.h"

namespace voxelcore
{

/** The same request of the shape in the frame: its sources are asked for what lies there in the scan. */
CertifiedRequest
InFrame(CertifiedRequest request, const BodyFrame & frame, const SpacingWeights & weights);

/** The same shape in its frame. */
CertifiedShape
InFrame(const CertifiedShape & shape, const BodyFrame & frame);

void
LeaveFrame(const BodyFrame & frame, PaintingBalls & balls);
void
LeaveFrame(const BodyFrame & frame, PlacedCore & core);
void
LeaveFrame(const BodyFrame & frame, CertifiedThickness & found);

/** Its branches are measured where they come to lie. */
void
LeaveFrame(const BodyFrame & frame, const RootChoice & root, CertifiedSkeleton & skeleton);

} // namespace voxelcore
