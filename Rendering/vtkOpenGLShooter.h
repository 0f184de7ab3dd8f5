// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLShooter
 * @brief progressive refinement on the GPU: shoot from the brightest patches, with no matrix
 *
 * What a shooter sees is drawn from eye points on it into an item buffer that covers the
 * hemisphere; each pixel then adds its view factor to the patch that it sees, by additive blending
 * into a texture with one texel per patch. Fronts receive, backs block and absorb. Unshot
 * radiosity, received power and the choice of the next shooters stay on the GPU: for up to 16 shots
 * the numbers and powers of 16 candidates are read back, of which those with at least half the
 * power of the first one shoot together. Up to 32 bands, all in one pass over the pixels. Runs are
 * repeatable: the same scene gives the same shots.
 *
 * Errors. The pixels of an eye point sum to 1, so energy is kept; how it is shared out has two
 * errors. Eye points stand for the parts of a patch that they are in the middle of, which is poor
 * for receivers nearer than such a part is large. And what is about as small as a pixel gets too
 * much or too little, and may be missed; frames are turned from one eye point to the next, so that
 * these errors average out over shots. Irradiance of the Cornell box (862 triangles) against exact
 * view factors when nothing is left to shoot, relative L2 error by Resolution (down) and
 * EyePointDensity (across):
 *
 * |     |    0 |  100 | 1000 | 10000 |
 * |----:|-----:|-----:|-----:|------:|
 * |  32 |      |      | 1.3% |       |
 * |  64 | 5.0% | 1.6% | 0.9% |  0.3% |
 * | 128 | 2.4% |      | 0.8% |       |
 *
 * What lies lower than 1e-6 of the scene's diagonal over the plane of a shooter is not seen from
 * it, and corners nearer to each other than about 1e-7 of it are not told apart: single precision.
 *
 * Sources: G. Coombe, M. J. Harris, A. Lastra, Radiosity on graphics hardware, Graphics Interface
 * 2004; hemisphere: the cubic tetrahedron of Beran-Koehn and Pavicic (1991).
 */
#ifndef vtkOpenGLShooter_h
#define vtkOpenGLShooter_h

#include "vtkDeviceShooter.h"
#include "vtkLightTransportRenderingModule.h" // for export macro

#include <memory> // for std::unique_ptr

namespace LightTransport
{
class DeviceWindow;
class ProgressiveShooter;
} // namespace LightTransport

class vtkRenderWindow;
class vtkTextureObject;

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLShooter : public vtkDeviceShooter
{
public:
  static vtkOpenGLShooter* New();
  vtkTypeMacro(vtkOpenGLShooter, vtkDeviceShooter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Most bands that vectors can have.
  static constexpr int MaximumNumberOfBands = 32;

  ///@{
  /// The window whose context is used, which has one already (render once); it is not kept alive.
  /// Default nullptr: an off-screen window that all filters of the process share. Another window
  /// ends what has been begun.
  void SetRenderWindow(vtkRenderWindow* window);
  vtkRenderWindow* GetRenderWindow();
  ///@}

  bool Open(std::string& reason) override;
  /// "OpenGL", and after Open() the name of the device, such as "OpenGL (llvmpipe (LLVM 15.0.6, 256
  /// bits))".
  const char* GetDeviceName() override;
  bool Initialize(const Patches& patches, int numberOfBands, const double* source,
    const double* reflectance) override;
  vtkIdType Shoot(vtkIdType numberOfShots) override;
  /**
   * Shoot for this long at most, or until shots are over that are made together; a call goes on
   * with those that the last one has left. Eye points are drawn in steps, and one that would not be
   * over in time waits, but for the first. Returns the number of shots that are over now, or -1
   * after an error, which has been reported; `isOver` tells that nothing is left to shoot.
   */
  vtkIdType ShootFor(double seconds, bool& isOver);

  ///@{
  /**
   * The radiosity so far, what is unshot included, as a texture of the context: a texel per patch,
   * row by row, of four bands in units of GetBandScale. With `ambient`, what patches will have to
   * reflect of what is still unshot, were it spread evenly, is added (Cohen et al. 1988). Scenes of
   * up to four bands; nullptr after an error, which has been reported.
   */
  vtkTextureObject* ComputeRadiosity(bool ambient);
  double GetBandScale(int band);
  ///@}

  bool GetLargestUnshot(double* perBand) override;
  bool GetIrradiance(double* values) override;
  bool GetUnshot(double* values) override;

  ///@{
  /**
   * Pixels along a side of each of the three faces that an eye point sees through; 1.5 times its
   * square see something. Odd ones are rounded down. Default 0: about as many pixels as patches, so
   * that neither drawing the scene nor handing out pixels takes most of the time, 64 to 1024. Range
   * 16 to 2048. Takes effect at the next Initialize().
   */
  void SetResolution(int resolution);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Eye points that a shot with all the emitted power is divided among; others have their share of
   * them, at least one for each triangle. Default 1000, at least 0. So most work goes where most
   * light comes from, and the sum over all shots hardly depends on the number of patches.
   */
  vtkSetClampMacro(EyePointDensity, double, 0.0, 1e9);
  vtkGetMacro(EyePointDensity, double);
  ///@}

  ///@{
  /**
   * Whether patches also shoot what they will have to reflect of all that is still unshot, were it
   * spread evenly (Feda and Purgathofer 1992): fewer shots in closed scenes. It ends by itself
   * where it does not help. Default on. Takes effect at the next Initialize().
   */
  vtkSetMacro(Overshooting, bool);
  vtkGetMacro(Overshooting, bool);
  vtkBooleanMacro(Overshooting, bool);
  ///@}

  ///@{
  /// Eye points and bytes read back since the last Initialize().
  vtkTypeInt64 GetNumberOfEyePoints();
  vtkTypeInt64 GetNumberOfBytesRead();
  ///@}

protected:
  vtkOpenGLShooter();
  ~vtkOpenGLShooter() override;

private:
  vtkOpenGLShooter(const vtkOpenGLShooter&) = delete;
  void operator=(const vtkOpenGLShooter&) = delete;

  bool CheckSizes(vtkIdType numberOfPatches, int numberOfBands);
  bool Begin(const double* source);
  bool AimAtNext(vtkIdType most);
  bool IsReady();

  int Resolution = 0;
  double EyePointDensity = 1000.0;
  bool Overshooting = true;
  double SecondsPerEye = 0.0; ///< of the last step of ShootFor
  vtkIdType Aimed = 0;        ///< shots under way

  const std::unique_ptr<LightTransport::DeviceWindow> Window;
  std::unique_ptr<LightTransport::ProgressiveShooter> Progress;
};

#endif
