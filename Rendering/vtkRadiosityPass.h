// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRadiosityPass
 * @brief draws radiosity as the light that a scene gives off, and solves the scene while it draws
 *
 * Colour = encoded(Exposure * Radiosity / pi), without VTK's lights: radiosity already holds all
 * light. See vtkTransportPass for what is drawn how.
 *
 * Without SetRadiosity actors are drawn that have the point array "Radiosity" of vtkRadiosity; the
 * pass solves nothing. With it the actors of the renderer are one scene, which is solved while it
 * is drawn. All take part that are visible, opaque, drawn as surfaces, and lit (vtkProperty::
 * Lighting), wherever the camera looks, also blocks of composite data with what their mapper says
 * of them (visibility, color); a warning names actors whose mapper keeps them from it. Others, and
 * parts of assemblies, are drawn as usual and cost nothing. Of three bands (red, green, blue)
 *
 *   reflectance = the cell array "Reflectance" where there is one, else the property's Diffuse x
 *                 DiffuseColor;
 *   emission    = the cell array "Emission" where there is one, else Ambient x AmbientColor;
 *   light       = the renderer's lights that are scene lights, with the shadows of all that takes
 *                 part, as vtkDirectIrradiance has it. Headlights and camera lights do not count:
 *                 a camera that moves would light another scene.
 *
 * (or the arrays that were chosen for inputs 0 and 1 of the vtkRadiosity). So with an Exposure of
 * pi the first reflection looks as VTK shades it.
 *
 * Each frame goes on for FrameBudget seconds and shows the estimate so far; IsConverged tells when
 * there is nothing left to do, and then frames are only drawn. The vtkRadiosity says how it is
 * solved:
 *
 * - Solver Southwell with Device OpenGL: progressive refinement by vtkOpenGLShooter in the window's
 *   own context, a few eye points at a time. Values stay on the GPU: means at points are drawn
 * there from those of the patches, with the weights of vtkRadiosity, since the estimate is another
 * in each frame. About 1 % off; needs no links.
 * - else the filter itself, with its links, solver and tolerance, on the CPU: links are kept, and
 *   serve other lights and materials. Links come whole, before which the first estimate is shown;
 *   then the solution is the filter's, and its point arrays are drawn.
 *
 * Vertices and lines of what takes part are drawn as usual, in the property's color.
 *
 * The first estimate is what shines and is lit directly (AmbientTerm adds to it). Before
 * it, and where the solution fails (an error tells why, once), actors are drawn as usual.
 *
 * What is computed again: nothing where the camera moves; direct light and solution where a light
 * does (one that moves all the time is shown where it was when its light was begun); the solution
 * for other materials; all where points or actors move, which are shown with their old light until
 * there is a new estimate. Each renderer has a solution of its own.
 */
#ifndef vtkRadiosityPass_h
#define vtkRadiosityPass_h

#include "vtkTransportPass.h"
#include "vtkWeakPointer.h" // for members

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

class vtkActor;
class vtkPolyData;
class vtkRadiosity;

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkRadiosityPass : public vtkTransportPass
{
public:
  static vtkRadiosityPass* New();
  vtkTypeMacro(vtkRadiosityPass, vtkTransportPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How the scene is solved: only the properties of the filter matter, nothing need be connected to
   * it, and it may be that of several passes. Links are those of the pass, unless view factors were
   * given to the filter. Default nullptr: arrays are drawn that have been computed before.
   */
  void SetRadiosity(vtkRadiosity* radiosity);
  vtkRadiosity* GetRadiosity();
  ///@}

  ///@{
  /// Seconds of a frame to solve in, beside drawing it; a step is not begun that would not be over
  /// by then, as far as can be foreseen. Default 0.05, range 0 (as little as possible) and above;
  /// with 1e6 the first frame shows the solution.
  vtkSetClampMacro(FrameBudget, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(FrameBudget, double);
  ///@}

  ///@{
  /// Whether estimates have an ambient term: what is still to be reflected, as if it were spread
  /// over the scene evenly and none of it left through openings. What has converged has none.
  /// Better in closed rooms, far too bright in the open. Default off.
  vtkSetMacro(AmbientTerm, bool);
  vtkGetMacro(AmbientTerm, bool);
  vtkBooleanMacro(AmbientTerm, bool);
  ///@}

  ///@{
  /// Whether the lights of the renderer cast shadows. Default on.
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /// Whether an actor that takes part is drawn as radiosity; else as usual, or as DelegatePass
  /// does: a vtkSubsurfaceScatteringPass there draws what is translucent. Default for all: on.
  void SetShown(vtkActor* actor, bool shown);
  bool IsShown(vtkActor* actor);
  ///@}

  /// Whether the last frame of each renderer shows a solution that has converged (or none where no
  /// actor takes part). False before the first frame; what changes is known in the next one.
  bool IsConverged();

  /**
   * All arrays of vtkRadiosity on the surface of an actor, in world coordinates, of the estimate so
   * far ("Irradiance" can light what is translucent), or of one of its visible blocks that have
   * polygons. What shots have brought is read back once for each estimate. nullptr where there is
   * no estimate yet, or the actor takes no part.
   */
  vtkPolyData* GetOutput(vtkActor* actor, int block = 0);

  ///@{
  /// How often links and direct light have been computed, solutions have been begun (with links:
  /// ended), and shots, over all renderers.
  vtkIdType GetNumberOfLinkRuns();
  vtkIdType GetNumberOfLightRuns();
  vtkIdType GetNumberOfSolverRuns();
  vtkIdType GetNumberOfShots();
  ///@}

  /// Seconds that solving has taken in the last frame: FrameBudget, or what it was exceeded by.
  vtkGetMacro(SolvingSeconds, double);

  /// Bytes that shots have read back, mostly to choose who shoots.
  vtkTypeInt64 GetNumberOfBytesRead();

  /// What has been shot is lost, and is shot again.
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkRadiosityPass();
  ~vtkRadiosityPass() override;

  bool UpdateMaps(const vtkRenderState* state) override;
  void ReplaceProps(const vtkRenderState* state, std::vector<vtkProp*>& props) override;
  LightTransport::RadianceShader::Source GetSource(vtkProp* prop) override;
  void SetMap(vtkShaderProgram* program, vtkProp* prop,
    LightTransport::RadianceShader::Uniforms& uniforms) override;
  void LetGoOfMaps() override;

  const char* GetFragmentShader() override;

private:
  vtkRadiosityPass(const vtkRadiosityPass&) = delete;
  void operator=(const vtkRadiosityPass&) = delete;

  struct Scene;

  Scene& FindScene(vtkRenderer* renderer);

  std::vector<std::unique_ptr<Scene>> Scenes;
  Scene* Drawn = nullptr;                       ///< in this frame
  std::vector<vtkWeakPointer<vtkActor>> Others; ///< that are not shown
  vtkSmartPointer<vtkRadiosity> Radiosity;
  double FrameBudget = 0.05;
  bool AmbientTerm = false;
  bool Shadows = true;
  double SolvingSeconds = 0.0;
};

#endif
