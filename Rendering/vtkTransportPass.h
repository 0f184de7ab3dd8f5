// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTransportPass
 * @brief what the render passes for transport results share: draws a point array as radiance
 *
 * The passes draw arrays that a filter has computed (vtkRadiosity, vtkSubsurfaceScattering), and
 * what they compute themselves for the actors of the scene. An array may have one component (grey)
 * or three (red, green, blue; a fourth is ignored), float or double, radiant exitance per unit
 * area, and is divided by pi: the surface is diffuse. Values are interpolated linearly over
 * triangles.
 *
 * Every visible actor whose mapper is a plain vtkPolyDataMapper with that point array in its input
 * is drawn so; all others are drawn as usual, also those with composite data, whose mappers take no
 * extra arrays. Both sides of a surface look alike. Where no visible actor has the array, or it has
 * another number of components, a warning names it.
 *
 * Use: renderer->SetPass(pass).
 */
#ifndef vtkTransportPass_h
#define vtkTransportPass_h

#include "vtkLightTransportRenderingModule.h" // for export macro
#include "vtkOpenGLRenderPass.h"
#include "vtkSmartPointer.h" // for members
#include "vtkTimeStamp.h"    // for members

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

namespace LightTransport
{
class MappedArrays;
namespace RadianceShader
{
enum class Source;
struct Uniforms;
} // namespace RadianceShader
} // namespace LightTransport

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkTransportPass : public vtkOpenGLRenderPass
{
public:
  vtkTypeMacro(vtkTransportPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputEncodingType
  {
    OUTPUT_ENCODING_LINEAR = 0,
    OUTPUT_ENCODING_SRGB = 1
  };

  ///@{
  /// The point array to draw. The default depends on the pass.
  void SetArrayName(const std::string& name);
  std::string GetArrayName() const { return this->ArrayName; }
  ///@}

  ///@{
  /// Factor on radiance before it is encoded. Default 1, range 0 and above.
  vtkSetClampMacro(Exposure, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /// How radiance becomes a colour: as it is, or (default) with the transfer curve of sRGB (IEC
  /// 61966-2-1).
  vtkSetClampMacro(OutputEncoding, int, OUTPUT_ENCODING_LINEAR, OUTPUT_ENCODING_SRGB);
  vtkGetMacro(OutputEncoding, int);
  void SetOutputEncodingToLinear() { this->SetOutputEncoding(OUTPUT_ENCODING_LINEAR); }
  void SetOutputEncodingToSRGB() { this->SetOutputEncoding(OUTPUT_ENCODING_SRGB); }
  ///@}

  ///@{
  /// What draws the props. Default: camera, lights, opaque, translucent, volumetric and overlay
  /// (vtkRenderStepsPass).
  void SetDelegatePass(vtkRenderPass* pass);
  vtkRenderPass* GetDelegatePass();
  ///@}

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /// Called by mappers.
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) override;
  vtkMTimeType GetShaderStageMTime() override;
  ///@}

protected:
  explicit vtkTransportPass(const std::string& arrayName);
  ~vtkTransportPass() override;

  /// The fragment shader's last step, which writes gl_FragData[0]; see
  /// glsl/vtkLightTransportPassesDecFS.glsl.
  virtual const char* GetFragmentShader() = 0;

  ///@{
  /// Uniforms of that step.
  virtual double GetFresnelIndex() { return 1.0; }
  virtual double GetMeanTransmittance() { return 1.0; }
  ///@}

  ///@{
  /**
   * For a pass that computes what it draws: bring that of a frame up to date before it is drawn,
   * and return whether any actor has any, or an error has told why not; put others in the place of
   * the props that are drawn; where the radiance of an actor comes from (None and Array are told
   * apart here); let a program of that actor's mapper use it, and say which material it is; let go
   * of it when the frame is drawn.
   */
  virtual bool UpdateMaps(const vtkRenderState* vtkNotUsed(state)) { return false; }
  virtual void ReplaceProps(const vtkRenderState* vtkNotUsed(state),
    std::vector<vtkProp*>& vtkNotUsed(props))
  {
  }
  virtual LightTransport::RadianceShader::Source GetSource(vtkProp* prop);
  virtual void SetMap(vtkShaderProgram* vtkNotUsed(program), vtkProp* vtkNotUsed(prop),
    LightTransport::RadianceShader::Uniforms& vtkNotUsed(uniforms))
  {
  }
  virtual void LetGoOfMaps() {}
  ///@}

  /// To be called where GetSource has changed for some actor.
  void MapsModified() { this->MapsTime.Modified(); }

private:
  vtkTransportPass(const vtkTransportPass&) = delete;
  void operator=(const vtkTransportPass&) = delete;

  void MapArrays(const vtkRenderState* state, bool areMapsUsed);
  LightTransport::RadianceShader::Source FindSource(vtkAbstractMapper* mapper, vtkProp* prop);

  std::string ArrayName;
  double Exposure = 1.0;
  int OutputEncoding = OUTPUT_ENCODING_SRGB;
  vtkSmartPointer<vtkRenderPass> DelegatePass;

  const std::unique_ptr<LightTransport::MappedArrays> Arrays;
  vtkTimeStamp MapsTime;
  bool Parallel = false; ///< the camera's projection
  bool Warned = false;
};

#endif
