// NIfTI's qform and sform: https://nifti.nimh.nih.gov/nifti-1/documentation/nifti1fields/nifti1fields_pages/qsform.html
//
// itk::NiftiImageIO chooses between them silently and scales the spacing by the unit but not the origin; the choice is
// repeated here (so that results lie on the scan as 3D Slicer shows it), said aloud, and everything is in mm.

#include "NiftiForms.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

// ITK's tolerance for calling an sform orthonormal, and for calling its scales those of pixdim (mm).
constexpr double kOrthonormalFormTolerance = 1e-4;
constexpr double kScaleTolerance = 1e-3;
// Forms further apart than this part of a voxel are reported.
constexpr double kWorthAWord = 0.1;

/** Directions of the axes (unit vectors, or columns with lengths), and origin; RAS mm. */
struct Form
{
  std::array<Vector3, 3> axes{};
  Vector3                origin{};
};

/** As nifti_quatern_to_mat44 has it: a rotation, its third axis reversed when qfac is negative. */
Form
Qform(const NiftiPlacement & p)
{
  double b = p.quaternion[0];
  double c = p.quaternion[1];
  double d = p.quaternion[2];
  double a = 1.0 - (b * b + c * c + d * d);
  if (a < 1e-7)
  {
    // A half turn: b, c, d are normalised, as single precision leaves them a little too long.
    const double length = std::sqrt(b * b + c * c + d * d);
    b /= length;
    c /= length;
    d /= length;
    a = 0.0;
  }
  else
  {
    a = std::sqrt(a);
  }
  const double qfac = p.pixdim[0] < 0 ? -1.0 : 1.0;
  Form         form;
  form.axes[0] = { a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c) };
  form.axes[1] = { 2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b) };
  form.axes[2] = { 2 * (b * d + a * c) * qfac, 2 * (c * d - a * b) * qfac, (a * a + d * d - c * c - b * b) * qfac };
  for (std::size_t i = 0; i < 3; ++i)
  {
    form.origin[i] = p.qoffset[i] * p.millimetres;
  }
  return form;
}

/** Its axes are the columns: a step from voxel to voxel in mm. */
Form
Sform(const NiftiPlacement & p)
{
  Form form;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      form.axes[axis][row] = p.srow[row][axis] * p.millimetres;
    }
    form.origin[row] = p.srow[row][3] * p.millimetres;
  }
  return form;
}

/** The farthest that a corner voxel of the scan moves from one form to the other; mm. */
double
LargestDistance(const Form & q, const Vector3 & spacing, const Form & s, const std::array<std::int64_t, 3> & size)
{
  double largest = 0;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    Vector3 difference{};
    for (std::size_t c = 0; c < 3; ++c)
    {
      difference[c] = q.origin[c] - s.origin[c];
      for (std::size_t a = 0; a < 3; ++a)
      {
        const double index = (corner >> a & 1U) != 0 ? static_cast<double>(size[a] - 1) : 0.0;
        difference[c] += index * (q.axes[a][c] * spacing[a] - s.axes[a][c]);
      }
    }
    largest = std::max(largest, Length(difference));
  }
  return largest;
}

/** RAS -> LPS. */
void
SetFromRas(Form form, const Vector3 & spacing, const ReadOptions & options, ScanFile & scan)
{
  for (std::size_t c = 0; c < 2; ++c)
  {
    form.origin[c] = -form.origin[c];
    for (Vector3 & axis : form.axes)
    {
      axis[c] = -axis[c];
    }
  }
  SetGeometry(scan, form.axes, spacing, form.origin, options);
}

void
UseSform(const Form & sform, const Vector3 & spacing, bool ownScales, const ReadOptions & options, ScanFile & scan)
{
  // The side of a voxel is stated twice, in pixdim and as the length of the sform's columns.
  Vector3 sides = spacing;
  bool    differ = false;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double column = Length(sform.axes[a]);
    // Up to rounding pixdim is the cleaner number.
    const double allowed = ownScales ? 1e-5 * column : kScaleTolerance;
    if (!(std::abs(column - spacing[a]) <= allowed))
    {
      differ = true;
      sides[a] = ownScales ? column : spacing[a];
    }
  }
  if (differ)
  {
    scan.warnings.push_back(Text("the sform's voxel (",
                                 Number(Length(sform.axes[0])),
                                 " x ",
                                 Number(Length(sform.axes[1])),
                                 " x ",
                                 Number(Length(sform.axes[2])),
                                 " mm) contradicts pixdim (",
                                 Number(spacing[0]),
                                 " x ",
                                 Number(spacing[1]),
                                 " x ",
                                 Number(spacing[2]),
                                 " mm): ",
                                 ownScales ? "the sform" : "pixdim, as ITK does,",
                                 " is taken"));
  }
  SetFromRas(sform, sides, options, scan);
}

} // namespace

void
PlaceNifti(const NiftiPlacement & p, const ReadOptions & options, ScanFile & scan)
{
  if (options.niftiForm != "auto" && options.niftiForm != "sform" && options.niftiForm != "qform")
  {
    throw UsageError(Text("--nifti-form ", Printable(options.niftiForm), ": give auto, sform or qform"));
  }
  const bool hasQform = p.qformCode > 0;
  const bool hasSform = p.sformCode > 0;
  const Form qform = Qform(p);
  const Form sform = Sform(p);
  Vector3    spacing{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    spacing[a] = p.pixdim[a + 1] * p.millimetres;
  }

  if (options.niftiForm == "sform" || options.niftiForm == "qform")
  {
    const bool wantSform = options.niftiForm == "sform";
    if (!(wantSform ? hasSform : hasQform))
    {
      RefuseInput(scan.path, Text("it has no ", options.niftiForm), "leave out --nifti-form");
    }
    scan.notes.push_back(Text("the ", options.niftiForm, " was asked for"));
    wantSform ? UseSform(sform, spacing, true, options, scan) : SetFromRas(qform, spacing, options, scan);
    return;
  }
  if (!hasQform && !hasSform)
  {
    scan.notes.push_back("the file has neither qform nor sform: axes are taken as LPS with origin 0, as ITK does");
    SetGeometry(scan, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, spacing, { 0, 0, 0 }, options);
    return;
  }

  const double skew = hasSform ? LargestCosine(sform.axes) : 0;
  const bool   orthonormal = skew <= kOrthonormalFormTolerance;
  const bool   useSform = hasSform && (!hasQform || (orthonormal && p.sformCode == 1));
  if (hasQform && hasSform)
  {
    if (!orthonormal)
    {
      scan.notes.push_back(Text("the sform is skewed (",
                                Number(std::asin(std::min(1.0, skew)) * 180.0 / 3.14159265358979323846),
                                " degrees), the qform is taken"));
    }
    const double distance = LargestDistance(qform, spacing, sform, scan.geometry.size);
    const double smallest = std::min({ spacing[0], spacing[1], spacing[2] });
    if (!(distance <= kWorthAWord * smallest))
    {
      scan.warnings.push_back(Text("qform and sform disagree by up to ",
                                   Number(distance),
                                   " mm: the ",
                                   useSform ? "sform" : "qform",
                                   " is taken, as ITK and 3D Slicer do (--nifti-form sform|qform overrides)"));
    }
  }
  useSform ? UseSform(sform, spacing, false, options, scan) : SetFromRas(qform, spacing, options, scan);
}

} // namespace voxelcore
