// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDeviceShooter
 * @brief progressive refinement of radiosity on a device, without a matrix, if one is registered
 *
 * Every patch holds unshot radiosity, at first its emission. A shot takes the patch with the most
 * unshot power, finds what it sees, hands its unshot radiosity out as irradiance, and what the
 * receivers reflect becomes unshot there (Cohen, Chen, Wallace and Greenberg 1988). No view factor
 * is kept: memory grows with the number of patches, and after a few shots there is a picture.
 *
 * The filters know nothing of OpenGL. New() asks VTK's object factories, quietly, and returns
 * nullptr when no loaded module implements this class; vtkLightTransportRendering does, with
 * vtkOpenGLShooter.
 *
 * Vectors are double, patches x bands, the bands of a patch next to each other.
 */
#ifndef vtkDeviceShooter_h
#define vtkDeviceShooter_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkObject.h"

#include <string> // for std::string
#include <vector> // for std::vector

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDeviceShooter : public vtkObject
{
public:
  /// May return nullptr: no module with a device shooter is loaded.
  static vtkDeviceShooter* New();
  vtkAbstractTypeMacro(vtkDeviceShooter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Planar convex polygons in any unit of length.
  struct Patches
  {
    std::vector<double> Points; ///< three coordinates each
    /// Where the corners of each patch begin, and at the end their number.
    std::vector<vtkIdType> Offsets;
    /// Indices of points, counter-clockwise seen from the front.
    std::vector<vtkIdType> Corners;
    std::vector<double> Normals; ///< three components each, of length 1, towards the front
    std::vector<double> Areas;
    /// How far over the plane of each patch a point is still on it, which is what coordinates are
    /// worth: a length, and a part of the distance. Empty: 0.
    std::vector<double> Roundings;
    std::vector<double> Slopes;
  };

  /**
   * Get ready to compute: for OpenGL, make or find a context. Returns false when that cannot be
   * done, never aborts, and reports nothing through vtkErrorMacro; `reason` then says in one
   * sentence why and what to install.
   */
  virtual bool Open(std::string& reason) = 0;

  /// What computes, for users, such as "OpenGL (llvmpipe ...)".
  virtual const char* GetDeviceName() = 0;

  /**
   * Begin with nothing shot: `source` is the unshot radiosity of every patch, `reflectance`
   * (0 to 1) what of its irradiance becomes unshot. False after an error, which has been reported.
   */
  virtual bool Initialize(const Patches& patches, int numberOfBands, const double* source,
    const double* reflectance) = 0;

  /**
   * Shoot `numberOfShots` times at most. Returns the number of shots, less than asked for only
   * where nothing is left to shoot, or -1 after an error, which has been reported.
   */
  virtual vtkIdType Shoot(vtkIdType numberOfShots) = 0;

  /// The largest magnitude of unshot radiosity in each band.
  virtual bool GetLargestUnshot(double* perBand) = 0;

  ///@{
  /**
   * The irradiance that shots have brought so far (without any direct one), and the unshot
   * radiosity. source + reflectance * irradiance is the radiosity so far, unshot included.
   */
  virtual bool GetIrradiance(double* values) = 0;
  virtual bool GetUnshot(double* values) = 0;
  ///@}

protected:
  vtkDeviceShooter();
  ~vtkDeviceShooter() override;

private:
  vtkDeviceShooter(const vtkDeviceShooter&) = delete;
  void operator=(const vtkDeviceShooter&) = delete;
};

#endif
