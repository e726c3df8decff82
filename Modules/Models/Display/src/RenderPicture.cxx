#include "voxelcore/Display/RenderPicture.h"

#include "ColorScale.h"
#include "DisplayMeshes.h"
#include "PanelLayout.h"
#include "PictureCamera.h"
#include "PictureFile.h"
#include "PictureMesh.h"
#include "PictureOverlay.h"
#include "ShownMesh.h"
#include "VirtualDisplay.h"
#include "voxelcore/Base/Error.h"

#include <vtkCamera.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <string>

namespace voxelcore
{

namespace
{

constexpr int         kOversampling = 2;     ///< pixels drawn for each of the picture, along each side
constexpr std::size_t kMostInLegend = 12;    ///< labels
constexpr double      kGlass = 0.16;         ///< opacity of a surface with something in it
constexpr std::size_t kMostOfGlass = 200000; ///< triangles of it, of each label
constexpr double      kLeastTube = 1.2;      ///< radius of a curve, in pixels of the picture
constexpr double      kSmall = 0.8;          ///< letters of names, in letters
constexpr double      kBarBottom = 12;       ///< of the colour bar, above directions and scale bar; in letters

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
    , m_Scale(content, options)
    , m_Text(kOversampling * std::max(0.022 * std::min<double>(options.height, 0.8 * options.width), 8.0))
  {
    FindContent();
    MakePanels();
    PlacePanels();
    MakeMeshes();
    m_Window->SetDisplayId(m_Display.Connection());
    m_Window->SetOffScreenRendering(1);
    m_Window->SetMultiSamples(0);
    m_Window->SetAlphaBitPlanes(1);
    m_Window->SetNumberOfLayers(2);
    Furnish();
  }

  Picture
  Take(double radians)
  {
    const PictureAxes axes = Turned(m_Axes, radians);
    const int         side = kOversampling * std::max(m_Options.tile, 1);
    Picture           picture = BlankPicture(m_Layout.width / kOversampling, m_Layout.height / kOversampling);
    for (int bottom = 0; bottom < m_Layout.height; bottom += side)
    {
      for (int left = 0; left < m_Layout.width; left += side)
      {
        TakeTile({ left, bottom, std::min(side, m_Layout.width - left), std::min(side, m_Layout.height - bottom) },
                 axes,
                 picture);
      }
    }
    RequireDrawn(picture);
    return picture;
  }

private:
  /** Pixels drawn, from the lower left of all of them. */
  struct Tile
  {
    int left;
    int bottom;
    int width;
    int height;
  };

  void
  TakeTile(const Tile & tile, const PictureAxes & axes, Picture & picture)
  {
    m_Window->SetSize(tile.width, tile.height);
    for (std::size_t i = 0; i < m_Renderers.size(); ++i)
    {
      Aim(m_Renderers[i], axes, Part(i), tile);
    }
    m_Overlay->RemoveAllViewProps();
    DrawOverlay(axes, tile);
    m_Window->Render();
    vtkNew<vtkUnsignedCharArray> drawn;
    m_Window->GetPixelData(0, 0, tile.width - 1, tile.height - 1, 0, drawn);
    if (drawn->GetNumberOfValues() != 3LL * tile.width * tile.height)
    {
      throw OutputError("cannot draw: OpenGL gives no picture on this display");
    }
    SetMeans(picture,
             drawn->GetPointer(0),
             tile.left / kOversampling,
             tile.bottom / kOversampling,
             tile.width / kOversampling,
             tile.height / kOversampling,
             kOversampling);
  }

  /** The pixels of a panel. */
  Tile
  Part(std::size_t panel) const
  {
    const auto [left, bottom] = m_Layout.Corner(panel, m_Request);
    const auto whole = [](double x) { return static_cast<int>(std::lround(x)); };
    return { whole(left),
             whole(bottom),
             whole(left + m_Layout.panelWidth) - whole(left),
             whole(bottom + m_Layout.panelHeight) - whole(bottom) };
  }

  void
  FindContent()
  {
    for (const DisplayLabel & label : m_Content.labels)
    {
      m_HasSurface = m_HasSurface || !label.surface.triangles.empty();
      m_HasMedial = m_HasMedial || label.medial.core.cells.vertexCount > 0;
      m_HasCurves = m_HasCurves || !label.curves.positions.empty();
    }
    if (!m_HasSurface && !m_HasMedial && !m_HasCurves)
    {
      throw UsageError("there is nothing to be drawn in these files; give others, or more labels");
    }
  }

  void
  MakeMeshes()
  {
    for (const DisplayLabel & label : m_Content.labels)
    {
      LabelMeshes meshes;
      if (!label.surface.triangles.empty())
      {
        const bool isGlass = !m_Options.panels && (m_HasMedial || m_HasCurves);
        if (isGlass && label.surface.triangles.size() > kMostOfGlass)
        {
          ShownMesh fewer = SimplifiedSurface(label.surface, kMostOfGlass);
          meshes.surface = SurfacePolyData({ std::move(fewer.points), std::move(fewer.triangles) });
        }
        else
        {
          meshes.surface = SurfacePolyData(label.surface);
        }
      }
      if (label.medial.core.cells.vertexCount > 0)
      {
        meshes.medial = MedialPolyData(label, m_Options.coloring);
      }
      if (!label.curves.positions.empty())
      {
        const double least = kLeastTube * kOversampling * m_Layout.mmPerPixel;
        meshes.curves = CurvePolyData(label, m_Options.coloring, m_Options.tubes, least);
      }
      m_Meshes.push_back(std::move(meshes));
    }
  }

  void
  MakePanels()
  {
    if (!m_Options.panels)
    {
      const bool inside = m_HasMedial || m_HasCurves;
      m_Panels.push_back({ m_Options.title, inside ? kGlass : 1.0, m_HasCurves ? 0.45 : 1.0, 1.0 });
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

  bool
  HasLegend() const
  {
    return !m_Scale.IsShown() && m_Content.labels.size() <= kMostInLegend;
  }

  /** Room at the right for colour bar or names, directions and scale bar, in heights of letters. */
  double
  RightMargin() const
  {
    constexpr double kLetter = 0.58;
    double           margin = 7;
    if (m_Scale.IsShown())
    {
      margin = std::max(8.4, 1.4 + kLetter * static_cast<double>(m_Scale.Bar().title.size()));
    }
    for (const DisplayLabel & label : m_Content.labels)
    {
      constexpr double kMost = 14;
      const double     name = 2.4 + kSmall * kLetter * static_cast<double>(label.name.size());
      margin = HasLegend() ? std::max(margin, std::min(name, kMost)) : margin;
    }
    return margin;
  }

  void
  PlacePanels()
  {
    m_Request.panels = m_Panels.size();
    m_Request.width = m_Options.width * kOversampling;
    m_Request.height = m_Options.height * kOversampling;
    m_Request.shrink = m_Options.shrink;
    m_Request.multiple = kOversampling;
    m_Request.left = m_Request.bottom = m_Request.top = 0.5 * m_Text;
    m_Request.right = RightMargin() * m_Text;
    m_Request.title = m_Options.panels || !m_Options.title.empty() ? 2 * m_Text : 0;
    m_Request.leastWidth = (m_Options.panels ? 9 : 6) * m_Text;
    m_Request.leastHeight = (kBarBottom + (HasLegend() ? 15 : 13)) * m_Text;
    m_Layout = LayOutPanels(m_Request, m_Frame);
  }

  /** Fills the window with a renderer for each panel and one for what is written over all. */
  void
  Furnish()
  {
    const double        background = m_Options.dark ? 0.0 : 1.0;
    vtkNew<vtkRenderer> blank; // the margins, too, must have the background
    blank->SetBackground(background, background, background);
    m_Window->AddRenderer(blank);
    for (std::size_t i = 0; i < m_Panels.size(); ++i)
    {
      vtkNew<vtkRenderer> renderer;
      renderer->SetBackground(background, background, background);
      renderer->SetUseDepthPeeling(1);
      renderer->SetMaximumNumberOfPeels(4);
      renderer->SetOcclusionRatio(0); // else what is peeled depends on how many pixels there are
      vtkNew<vtkLightKit> lights;
      constexpr double    kWhite = 0.5; // colours stay those of the bar
      lights->SetKeyLightWarmth(kWhite);
      lights->SetFillLightWarmth(kWhite);
      lights->SetBackLightWarmth(kWhite);
      lights->SetHeadLightWarmth(kWhite);
      lights->SetKeyLightIntensity(0.85);
      lights->AddLightsToRenderer(renderer);
      for (std::size_t k = 0; k < m_Meshes.size(); ++k)
      {
        const DisplayLabel &   label = m_Content.labels[k];
        vtkLookupTable * const scale = m_Scale.Table(k);
        // With a colour scale the surface is neutral, lest its colour be taken for a length.
        const Color plain = m_Scale.IsShown() && m_Meshes.size() == 1 ? Color{ 0.72, 0.74, 0.78 } : label.color;
        AddMesh(renderer, m_Meshes[k].surface, plain, nullptr, m_Panels[i].surface, kOversampling);
        AddMesh(renderer, m_Meshes[k].medial, label.color, scale, m_Panels[i].medial, kOversampling);
        AddMesh(renderer, m_Meshes[k].curves, label.color, scale, m_Panels[i].curves, kOversampling);
      }
      m_Window->AddRenderer(renderer);
      m_Renderers.push_back(renderer);
    }
    m_Overlay->SetLayer(1);
    m_Overlay->InteractiveOff();
    m_Window->AddRenderer(m_Overlay);
  }

  /** At the part of a panel that lies in a tile. */
  void
  Aim(vtkRenderer * renderer, const PictureAxes & axes, const Tile & panel, const Tile & tile) const
  {
    const int  left = std::max(panel.left, tile.left);
    const int  right = std::min(panel.left + panel.width, tile.left + tile.width);
    const int  bottom = std::max(panel.bottom, tile.bottom);
    const int  top = std::min(panel.bottom + panel.height, tile.bottom + tile.height);
    const bool isSeen = left < right && bottom < top;
    renderer->SetDraw(isSeen ? 1 : 0);
    if (!isSeen)
    {
      return;
    }
    const auto share = [](int part, int all) { return static_cast<double>(part) / all; };
    renderer->SetViewport(share(left - tile.left, tile.width),
                          share(bottom - tile.bottom, tile.height),
                          share(right - tile.left, tile.width),
                          share(top - tile.bottom, tile.height));
    vtkCamera * const camera = renderer->GetActiveCamera();
    const double      away = 4 * (m_Frame.halfWidth + m_Frame.halfHeight + m_Frame.halfDepth) + 1;
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(m_Frame.center.data());
    camera->SetPosition(m_Frame.center[0] + away * axes.back[0],
                        m_Frame.center[1] + away * axes.back[1],
                        m_Frame.center[2] + away * axes.back[2]);
    camera->SetViewUp(axes.up.data());
    camera->SetParallelScale(m_Layout.mmPerPixel * m_Layout.panelHeight / 2 * share(top - bottom, panel.height));
    // How far the middle of what is seen is from that of the panel, in halves of it.
    camera->SetWindowCenter(share(left + right - 2 * panel.left - panel.width, right - left),
                            share(bottom + top - 2 * panel.bottom - panel.height, top - bottom));
    renderer->ResetCameraClippingRange();
  }

  void
  DrawOverlay(const PictureAxes & axes, const Tile & tile)
  {
    PictureOverlay overlay(m_Overlay,
                           m_Options.dark,
                           { static_cast<double>(tile.left), static_cast<double>(tile.bottom) });
    const double   x = m_Layout.width - m_Request.right + m_Text;
    if (m_Scale.IsShown())
    {
      const double room = m_Layout.height - (kBarBottom + 3.5) * m_Text;
      overlay.AddColorBar(m_Scale.Bar(), x, kBarBottom * m_Text, std::min(room, 20 * m_Text), m_Text);
    }
    else if (HasLegend())
    {
      std::vector<std::pair<std::string, Color>> names;
      for (const DisplayLabel & label : m_Content.labels)
      {
        names.emplace_back(label.name, label.color);
      }
      overlay.AddLegend(names, x, m_Layout.height - 2 * m_Text, kSmall * m_Text);
    }
    overlay.AddScaleBar(m_Layout.mmPerPixel, m_Content.unit, m_Request.right - 2 * m_Text, x, 1.2 * m_Text, m_Text);
    if (m_Options.anatomical)
    {
      overlay.AddDirections(axes.right, axes.up, x + 2.5 * m_Text, 6.6 * m_Text, 1.7 * m_Text, m_Text);
    }
    for (std::size_t i = 0; m_Request.title > 0 && i < m_Panels.size(); ++i)
    {
      const auto   corner = m_Layout.Corner(i, m_Request);
      const double middle = corner[0] + m_Layout.panelWidth / 2;
      overlay.AddText(m_Panels[i].title, middle, corner[1] + m_Layout.panelHeight + m_Text, 1.1 * m_Text, 0);
    }
  }

  const DisplayContent &     m_Content;
  const PictureOptions &     m_Options;
  VirtualDisplay             m_Display; // outlives the window
  PointCloud                 m_Points;
  PictureAxes                m_Axes;
  PictureFrame               m_Frame;
  ColorScale                 m_Scale;
  double                     m_Text; ///< height of letters in pixels drawn
  std::vector<LabelMeshes>   m_Meshes;
  bool                       m_HasSurface = false;
  bool                       m_HasMedial = false;
  bool                       m_HasCurves = false;
  std::vector<Panel>         m_Panels;
  PanelRequest               m_Request;
  PanelLayout                m_Layout;
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
  try
  {
    Stage stage(content, options);
    for (int frame = 0; frame < options.frames; ++frame)
    {
      take(frame, stage.Take(2 * std::numbers::pi * frame / options.frames));
      ReportProgress(progress, "drawing", static_cast<double>(frame + 1) / options.frames);
    }
  }
  catch (const std::bad_alloc &)
  {
    throw OutputError("not enough memory for a picture of " + std::to_string(options.width) + "x" +
                      std::to_string(options.height) + " pixels; ask for a smaller one with --size");
  }
}

} // namespace voxelcore
