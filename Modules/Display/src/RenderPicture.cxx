#include "voxelcore/RenderPicture.h"

#include "DisplayMeshes.h"
#include "PictureCamera.h"
#include "PictureFile.h"
#include "PictureMesh.h"
#include "PictureOverlay.h"
#include "VirtualDisplay.h"
#include "voxelcore/DisplayColors.h"
#include "voxelcore/Error.h"

#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace voxelcore
{

namespace
{

constexpr int         kOversampling = 2;  ///< pixels drawn for each of the picture, along each side
constexpr std::size_t kMostInLegend = 12; ///< labels
constexpr double      kGlass = 0.16;      ///< opacity of a surface with something in it

std::string
TitleOf(PictureColoring coloring)
{
  switch (coloring)
  {
    case PictureColoring::Lambda:
      return "Lambda (mm)";
    case PictureColoring::ErosionThickness:
      return "Erosion thickness (mm)";
    default:
      return "Radius (mm)";
  }
}

PointCloud
AllPoints(const DisplayContent & content)
{
  PointCloud points;
  const auto add = [&points](const auto & positions) {
    for (const auto & p : positions)
    {
      points.push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
    }
  };
  for (const DisplayLabel & label : content.labels)
  {
    add(label.surface.points);
    add(label.medial.core.positions);
    add(label.curves.positions);
  }
  return points;
}

/** What is drawn of one label. */
struct LabelMeshes
{
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkPolyData> medial;
  vtkSmartPointer<vtkPolyData> curves;
};

/** One of the pictures side by side: 0 for nothing, else an opacity. */
struct Panel
{
  std::string title;
  double      surface = 0;
  double      medial = 0;
  double      curves = 0;
};

class Stage
{
public:
  Stage(const DisplayContent & content, const PictureOptions & options)
    : m_Content(content)
    , m_Options(options)
    , m_Points(AllPoints(content))
    , m_Axes(AxesOf(options.view, m_Points))
    , m_Frame(FrameOf(m_Points, m_Axes, std::max(options.frames, 1)))
    , m_Width(options.width * kOversampling)
    , m_Height(options.height * kOversampling)
    , m_Text(std::max(0.022 * std::min<double>(m_Height, 0.8 * m_Width), 8.0 * kOversampling))
  {
    MakeMeshes();
    FindRange();
    MakePanels();
    m_Window->SetDisplayId(m_Display.Connection());
    m_Window->SetOffScreenRendering(1);
    m_Window->SetMultiSamples(0);
    m_Window->SetAlphaBitPlanes(1);
    m_Window->SetNumberOfLayers(2);
    m_Window->SetSize(m_Width, m_Height);
    Furnish();
  }

  Picture
  Take(double radians)
  {
    const PictureAxes axes = Turned(m_Axes, radians);
    for (vtkRenderer * renderer : m_Renderers)
    {
      Aim(renderer, axes);
    }
    m_Overlay->RemoveAllViewProps();
    DrawOverlay(axes);
    m_Window->Render();
    vtkNew<vtkUnsignedCharArray> drawn;
    m_Window->GetPixelData(0, 0, m_Width - 1, m_Height - 1, 0, drawn);
    if (drawn->GetNumberOfValues() != 3LL * m_Width * m_Height)
    {
      throw OutputError("cannot draw: OpenGL gives no picture on this display");
    }
    return MeanPicture(drawn->GetPointer(0), m_Options.width, m_Options.height, kOversampling);
  }

private:
  void
  MakeMeshes()
  {
    const double least = 0.0025 * std::hypot(m_Frame.halfWidth, m_Frame.halfHeight);
    for (const DisplayLabel & label : m_Content.labels)
    {
      LabelMeshes meshes;
      if (!label.surface.triangles.empty())
      {
        meshes.surface = SurfacePolyData(label.surface);
        m_HasSurface = true;
      }
      if (label.medial.core.cells.vertexCount > 0)
      {
        meshes.medial = MedialPolyData(label, m_Options.coloring);
        m_HasMedial = true;
      }
      if (!label.curves.positions.empty())
      {
        meshes.curves = CurvePolyData(label, m_Options.coloring, m_Options.tubes, least);
        m_HasCurves = true;
      }
      m_Meshes.push_back(std::move(meshes));
    }
    if (!m_HasSurface && !m_HasMedial && !m_HasCurves)
    {
      throw UsageError("there is nothing to be drawn in these files");
    }
  }

  void
  FindRange()
  {
    m_Low = std::numeric_limits<double>::infinity();
    m_High = -m_Low;
    for (const LabelMeshes & meshes : m_Meshes)
    {
      for (vtkPolyData * data : { meshes.medial.Get(), meshes.curves.Get() })
      {
        const auto * shown =
          data != nullptr ? vtkFloatArray::SafeDownCast(data->GetPointData()->GetArray(kShownArray)) : nullptr;
        for (vtkIdType i = 0; shown != nullptr && i < shown->GetNumberOfTuples(); ++i)
        {
          const double value = shown->GetValue(i);
          if (std::isfinite(value))
          {
            m_Low = std::min(m_Low, value);
            m_High = std::max(m_High, value);
          }
        }
      }
    }
    if (m_Options.range)
    {
      m_Low = (*m_Options.range)[0];
      m_High = (*m_Options.range)[1];
    }
    m_HasScale = m_Options.coloring != PictureColoring::Label && m_Low <= m_High;
    constexpr int kColors = 256;
    m_Table->SetNumberOfTableValues(kColors);
    for (int i = 0; i < kColors; ++i)
    {
      const Color color = ViridisColor((i + 0.5) / kColors);
      m_Table->SetTableValue(i, color[0], color[1], color[2], 1);
    }
    m_Table->SetNanColor(0.6, 0.6, 0.6, 1);
    if (m_HasScale)
    {
      m_Table->SetRange(m_Low, m_High > m_Low ? m_High : m_Low + 1);
    }
  }

  void
  MakePanels()
  {
    if (!m_Options.panels)
    {
      const bool inside = m_HasMedial || m_HasCurves;
      m_Panels.push_back({ "", inside ? kGlass : 1.0, m_HasCurves ? 0.45 : 1.0, 1.0 });
      return;
    }
    if (m_HasSurface)
    {
      m_Panels.push_back({ "surface", 1.0, 0, 0 });
    }
    if (m_HasMedial)
    {
      m_Panels.push_back({ "medial surface", kGlass, 1.0, 0 });
    }
    if (m_HasCurves)
    {
      m_Panels.push_back({ "curve skeleton", kGlass, 0, 1.0 });
    }
  }

  double
  RightMargin() const
  {
    return (m_Options.coloring == PictureColoring::ErosionThickness ? 12.5 : 9) * m_Text;
  }

  /** Fills the window with a renderer for each panel and one for what is written over all. */
  void
  Furnish()
  {
    const double        background = m_Options.dark ? 0.0 : 1.0;
    const double        left = 0.5 * m_Text;
    const double        bottom = 4 * m_Text;
    const double        width = (m_Width - left - RightMargin()) / static_cast<double>(m_Panels.size());
    const double        top = m_Height - (m_Options.panels ? 3 : 0.5) * m_Text;
    vtkNew<vtkRenderer> blank; // the margins, too, must have the background
    blank->SetBackground(background, background, background);
    m_Window->AddRenderer(blank);
    for (std::size_t i = 0; i < m_Panels.size(); ++i)
    {
      const double        from = left + width * static_cast<double>(i);
      vtkNew<vtkRenderer> renderer;
      renderer->SetViewport(from / m_Width, bottom / m_Height, (from + width) / m_Width, top / m_Height);
      renderer->SetBackground(background, background, background);
      renderer->SetUseDepthPeeling(1);
      renderer->SetMaximumNumberOfPeels(4);
      renderer->SetOcclusionRatio(0.01);
      vtkNew<vtkLightKit> lights;
      lights->AddLightsToRenderer(renderer);
      vtkLookupTable * const scale = m_HasScale ? m_Table.Get() : nullptr;
      for (std::size_t k = 0; k < m_Meshes.size(); ++k)
      {
        const DisplayLabel & label = m_Content.labels[k];
        // With a colour scale the surface is neutral, lest its colour be taken for a length.
        const Color plain = m_HasScale && m_Meshes.size() == 1 ? Color{ 0.72, 0.74, 0.78 } : label.color;
        AddMesh(renderer, m_Meshes[k].surface, plain, nullptr, m_Panels[i].surface, kOversampling);
        AddMesh(renderer, m_Meshes[k].medial, label.color, scale, m_Panels[i].medial, kOversampling);
        AddMesh(renderer, m_Meshes[k].curves, label.color, scale, m_Panels[i].curves, kOversampling);
      }
      m_Window->AddRenderer(renderer);
      m_Renderers.push_back(renderer);
    }
    m_PanelWidth = width;
    m_PanelHeight = top - bottom;
    constexpr double kAir = 1.06;
    m_MmPerPixel = kAir * std::max(2 * m_Frame.halfWidth / m_PanelWidth, 2 * m_Frame.halfHeight / m_PanelHeight);
    if (!(m_MmPerPixel > 0))
    {
      m_MmPerPixel = 1 / m_PanelHeight; // a single point
    }
    m_Overlay->SetLayer(1);
    m_Overlay->InteractiveOff();
    m_Window->AddRenderer(m_Overlay);
  }

  void
  Aim(vtkRenderer * renderer, const PictureAxes & axes)
  {
    vtkCamera * const camera = renderer->GetActiveCamera();
    const double      away = 4 * (m_Frame.halfWidth + m_Frame.halfHeight + m_Frame.halfDepth) + 1;
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(m_Frame.center.data());
    camera->SetPosition(m_Frame.center[0] + away * axes.back[0],
                        m_Frame.center[1] + away * axes.back[1],
                        m_Frame.center[2] + away * axes.back[2]);
    camera->SetViewUp(axes.up.data());
    camera->SetParallelScale(m_MmPerPixel * m_PanelHeight / 2);
    renderer->ResetCameraClippingRange();
  }

  void
  DrawOverlay(const PictureAxes & axes)
  {
    PictureOverlay overlay(m_Overlay, m_Options.dark);
    const double   x = m_Width - RightMargin() + m_Text;
    const double   arm = 1.7 * m_Text;
    if (m_HasScale)
    {
      overlay.AddColorBar(TitleOf(m_Options.coloring), m_Low, m_High, x, 0.35 * m_Height, 0.45 * m_Height, m_Text);
    }
    else if (m_Content.labels.size() <= kMostInLegend)
    {
      std::vector<std::pair<std::string, Color>> names;
      for (const DisplayLabel & label : m_Content.labels)
      {
        names.emplace_back(label.name, label.color);
      }
      overlay.AddLegend(names, x, 0.85 * m_Height, 0.8 * m_Text);
    }
    overlay.AddScaleBar(m_MmPerPixel, m_PanelWidth / 3, 1.2 * m_Text, 1.2 * m_Text, m_Text);
    overlay.AddDirections(axes.right, axes.up, m_Width - 4.5 * m_Text, 4.5 * m_Text, arm, m_Text);
    for (std::size_t i = 0; m_Options.panels && i < m_Panels.size(); ++i)
    {
      const double middle = 0.5 * m_Text + m_PanelWidth * (static_cast<double>(i) + 0.5);
      overlay.AddText(m_Panels[i].title, middle, m_Height - 1.5 * m_Text, 1.1 * m_Text, 0);
    }
  }

  const DisplayContent &     m_Content;
  const PictureOptions &     m_Options;
  VirtualDisplay             m_Display; // outlives the window
  PointCloud                 m_Points;
  PictureAxes                m_Axes;
  PictureFrame               m_Frame;
  int                        m_Width;
  int                        m_Height;
  double                     m_Text; ///< height of letters in pixels drawn
  std::vector<LabelMeshes>   m_Meshes;
  bool                       m_HasSurface = false;
  bool                       m_HasMedial = false;
  bool                       m_HasCurves = false;
  bool                       m_HasScale = false;
  double                     m_Low = 0;
  double                     m_High = 0;
  vtkNew<vtkLookupTable>     m_Table;
  std::vector<Panel>         m_Panels;
  double                     m_PanelWidth = 0;
  double                     m_PanelHeight = 0;
  double                     m_MmPerPixel = 1;
  vtkNew<vtkRenderWindow>    m_Window;
  std::vector<vtkRenderer *> m_Renderers; ///< the window owns them
  vtkNew<vtkRenderer>        m_Overlay;
};

} // namespace

void
RenderPictures(const DisplayContent &                                  content,
               const PictureOptions &                                  options,
               const std::function<void(int frame, const Picture &)> & take,
               const ProgressCallback &                                progress)
{
  ReportProgress(progress, "drawing", 0);
  Stage stage(content, options);
  for (int frame = 0; frame < options.frames; ++frame)
  {
    take(frame, stage.Take(2 * std::numbers::pi * frame / options.frames));
    ReportProgress(progress, "drawing", static_cast<double>(frame + 1) / options.frames);
  }
}

} // namespace voxelcore
