// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLScatteredMap
 * @brief what a translucent surface gives back, from what enters it, as a map of its atlas on the
 * GPU
 *
 * Second of the three steps of vtkSubsurfaceScatteringPass, usable alone behind a
 * vtkOpenGLTransmittedMap. The texels of the surface's atlas, at this map's own resolution, are the
 * patches of a vtkSubsurfaceScattering: it holds the material and says which links there are, and
 * of what kind. They are put on the GPU and applied there to the map of what enters; neither map is
 * read back. (The shape of the texels is, once for each shape: links are made on the CPU.)
 *
 * Where the map of what enters is finer, its level of as many texels is taken, which is a mean over
 * the surface; where it is coarser, each of its texels counts for all that are in it.
 *
 * Texels hold (exitance x area, area), exitance as in "ScatteredIrradiance".
 */
#ifndef vtkOpenGLScatteredMap_h
#define vtkOpenGLScatteredMap_h

#include "vtkLightTransportRenderingModule.h" // for export macro
#include "vtkNew.h"                           // for members
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include <memory> // for std::unique_ptr

class vtkImageData;
class vtkOpenGLAtlasTexture;
class vtkOpenGLTransmittedMap;
class vtkSubsurfaceScattering;

namespace LightTransport
{
class Outcome;
}

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLScatteredMap : public vtkObject
{
public:
  static vtkOpenGLScatteredMap* New();
  vtkTypeMacro(vtkOpenGLScatteredMap, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Texels a side, a power of two. Default 512, range 1 to 2048.
  vtkSetClampMacro(Resolution, int, 1, 2048);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The material and its links. Nothing need be connected to the filter; its Incidence does
   * not matter, and Device says only where links are chosen. Models that are profiles only. Default
   * nullptr, which is an error in Update.
   */
  void SetMaterial(vtkSubsurfaceScattering* material);
  vtkSubsurfaceScattering* GetMaterial();
  ///@}

  /**
   * Brings the map up to date with what enters, which is up to date. Links are made where the shape
   * of the surface, the material or Resolution has changed; they are applied where they are others
   * or what enters has been drawn anew. Returns false, with an error, where that cannot be done;
   * called again, it says so again only when something has changed.
   */
  bool Update(vtkOpenGLTransmittedMap* entering);

  /// The map: three components.
  vtkOpenGLAtlasTexture* GetTexture();

  /// The texels that are linked, as vtkSurfaceToAtlas makes them, with "LinkRow"; empty before
  /// Update.
  vtkImageData* GetTexels();

  ///@{ How often Update has made links, and applied them.
  vtkGetMacro(NumberOfLinkRuns, vtkIdType);
  vtkGetMacro(NumberOfScatteringRuns, vtkIdType);
  ///@}

  ///@{ Bytes of values read back from the links on the GPU: 0; and of the links there.
  vtkTypeInt64 GetNumberOfBytesRead();
  vtkTypeInt64 GetNumberOfLinkBytes();
  ///@}

  /// Gives all memory on the device back; Update makes it again. Links are kept.
  void ReleaseGraphicsResources();

protected:
  vtkOpenGLScatteredMap();
  ~vtkOpenGLScatteredMap() override;

private:
  vtkOpenGLScatteredMap(const vtkOpenGLScatteredMap&) = delete;
  void operator=(const vtkOpenGLScatteredMap&) = delete;

  struct Parts;

  LightTransport::Outcome Refresh(vtkOpenGLTransmittedMap* entering);
  LightTransport::Outcome MakeLinks(vtkOpenGLTransmittedMap* entering);
  LightTransport::Outcome Open(vtkOpenGLTransmittedMap* entering);
  LightTransport::Outcome Upload();
  void UploadTables(int width, int height);
  LightTransport::Outcome Apply(vtkOpenGLTransmittedMap* entering);

  vtkNew<vtkOpenGLAtlasTexture> Texture;
  vtkNew<vtkImageData> Texels;
  vtkSmartPointer<vtkSubsurfaceScattering> Material;
  const std::unique_ptr<Parts> Device;
  int Resolution = 512;
  vtkIdType NumberOfLinkRuns = 0;
  vtkIdType NumberOfScatteringRuns = 0;
};

#endif
