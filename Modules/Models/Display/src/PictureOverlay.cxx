#include "PictureOverlay.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Models/DisplayColors.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace voxelcore
{

void
PictureOverlay::AddText(const std::string & words, double x, double y, double size, int align)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  vtkTextProperty * const style = actor->GetTextProperty();
  style->SetFontFamilyToArial();
  style->SetFontSize(static_cast<int>(size));
  style->SetColor(m_Ink[0], m_Ink[1], m_Ink[2]);
  style->SetJustification(align < 0 ? VTK_TEXT_LEFT : align > 0 ? VTK_TEXT_RIGHT : VTK_TEXT_CENTERED);
  style->SetVerticalJustificationToCentered();
  actor->SetPosition(x - m_Origin[0], y - m_Origin[1]);
  m_Renderer->AddActor2D(actor);
}

void
PictureOverlay::AddPolygon(const std::vector<std::array<double, 2>> & corners, const Color & color)
{
  vtkNew<vtkPoints>    points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(corners.size()));
  for (const auto & corner : corners)
  {
    cells->InsertCellPoint(points->InsertNextPoint(corner[0] - m_Origin[0], corner[1] - m_Origin[1], 0));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  m_Renderer->AddActor2D(actor);
}

void
PictureOverlay::AddRectangle(double x, double y, double width, double height, const Color & color)
{
  AddPolygon({ { x, y }, { x + width, y }, { x + width, y + height }, { x, y + height } }, color);
}

void
PictureOverlay::AddLine(double x0, double y0, double x1, double y1, double width)
{
  // A rectangle: lines wider than a pixel are not drawn alike everywhere.
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (length <= 0)
  {
    return;
  }
  const double dx = (x1 - x0) / length * width / 2;
  const double dy = (y1 - y0) / length * width / 2;
  AddPolygon({ { x0 - dy, y0 + dx }, { x0 + dy, y0 - dx }, { x1 + dy, y1 - dx }, { x1 - dy, y1 + dx } }, m_Ink);
}

void
PictureOverlay::AddColorBar(const ColorBar & bar, double x, double y, double height, double text)
{
  const double                 width = 0.8 * text;
  constexpr int                kSteps = 256;
  vtkNew<vtkPoints>            points;
  vtkNew<vtkCellArray>         cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType step = 0; step < kSteps; ++step)
  {
    for (const auto & [right, up] : { std::pair{ 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } })
    {
      points->InsertNextPoint(x + right * width - m_Origin[0],
                              y + height * static_cast<double>(step + up) / kSteps - m_Origin[1],
                              0);
    }
    cells->InsertNextCell({ 4 * step, 4 * step + 1, 4 * step + 2, 4 * step + 3 });
    for (const double part : LengthColor((static_cast<double>(step) + 0.5) / kSteps))
    {
      colors->InsertNextValue(static_cast<unsigned char>(std::lround(255 * part)));
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  m_Renderer->AddActor2D(actor);
  const double point = 0.9 * text;
  if (bar.below)
  {
    AddPolygon({ { x, y }, { x + width / 2, y - point }, { x + width, y } }, LengthColor(0));
  }
  if (bar.above)
  {
    AddPolygon({ { x, y + height }, { x + width, y + height }, { x + width / 2, y + height + point } }, LengthColor(1));
  }
  for (const auto & [place, words] : bar.ticks)
  {
    const double at = y + place * height;
    AddLine(x + width, at, x + width + 0.3 * text, at, text / 12);
    AddText(words, x + width + 0.5 * text, at, text, -1);
  }
  AddText(bar.title, x, y + height + (bar.above ? 1.8 : 1.1) * text, text, -1);
  if (!bar.caption.empty())
  {
    AddText(bar.caption, x, y - (bar.below ? 1.8 : 1.2) * text, 0.75 * text, -1);
  }
}

void
PictureOverlay::AddLegend(const std::vector<std::pair<std::string, Color>> & names, double x, double top, double text)
{
  double y = top;
  for (const auto & [name, color] : names)
  {
    AddRectangle(x, y - 0.4 * text, 0.8 * text, 0.8 * text, color);
    AddText(name, x + 1.2 * text, y, text, -1);
    y -= 1.5 * text;
  }
}

void
PictureOverlay::AddScaleBar(double mmPerPixel, SpatialUnit lengths, double most, double x, double y, double text)
{
  const double     mm = RoundDown(mmPerPixel * most);
  const double     length = mm / mmPerPixel;
  const LengthUnit unit = LengthUnit::For(mm * (1 + 1e-9), lengths); // powers of ten are not exact
  AddLine(x, y, x + length, y, text / 6);
  AddLine(x, y - text / 4, x, y + text / 4, text / 12);
  AddLine(x + length, y - text / 4, x + length, y + text / 4, text / 12);
  AddText(ShortText(unit.Of(mm), 6) + " " + unit.Symbol(), x + length / 2, y + 0.9 * text, text, 0);
}

std::array<double, 3>
PictureOverlay::LetterDistances(const std::array<double, 3> & right,
                                const std::array<double, 3> & up,
                                double                        arm,
                                double                        text)
{
  constexpr double                   kShort = 0.45; // nearly along the view
  std::array<double, 3>              distances{};
  std::vector<std::array<double, 2>> placed; // one letter of each axis; the other one lies opposite
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = std::hypot(right[axis], up[axis]);
    if (length < kShort)
    {
      continue;
    }
    double     distance = arm * length + 0.7 * text;
    const auto place = [&] {
      return std::array<double, 2>{ distance * right[axis] / length, distance * up[axis] / length };
    };
    const auto isFree = [&] {
      return std::none_of(placed.begin(), placed.end(), [&](const auto & other) {
        const auto here = place();
        return std::min(std::hypot(here[0] - other[0], here[1] - other[1]),
                        std::hypot(here[0] + other[0], here[1] + other[1])) < text;
      });
    };
    while (!isFree()) // ends two letters beyond all others at the latest
    {
      distance += text / 8;
    }
    placed.push_back(place());
    distances[axis] = distance;
  }
  return distances;
}

void
PictureOverlay::AddDirections(const std::array<double, 3> & right,
                              const std::array<double, 3> & up,
                              double                        x,
                              double                        y,
                              double                        arm,
                              double                        text)
{
  constexpr std::array<const char *, 3> toward{ "L", "P", "S" };
  constexpr std::array<const char *, 3> from{ "R", "A", "I" };
  const std::array<double, 3>           distances = LetterDistances(right, up, arm, text);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (distances[axis] == 0)
    {
      continue;
    }
    const double dx = right[axis];
    const double dy = up[axis];
    AddLine(x - arm * dx, y - arm * dy, x + arm * dx, y + arm * dy, text / 14);
    const double away = distances[axis] / std::hypot(dx, dy);
    AddText(toward[axis], x + away * dx, y + away * dy, text, 0);
    AddText(from[axis], x - away * dx, y - away * dy, text, 0);
  }
}

} // namespace voxelcore
