// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDeviceLinkOperator
 * @brief a link operator on a device other than the CPU, if one has been registered
 *
 * The filters know nothing of OpenGL. New() asks VTK's object factories, quietly, and returns
 * nullptr when no loaded module implements this class; vtkLightTransportRendering does, with
 * vtkOpenGLLinkOperator.
 */
#ifndef vtkDeviceLinkOperator_h
#define vtkDeviceLinkOperator_h

#include "vtkLinkOperator.h"

#include <string> // for std::string

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDeviceLinkOperator : public vtkLinkOperator
{
public:
  /// May return nullptr: no module with a device operator is loaded.
  static vtkDeviceLinkOperator* New();
  vtkAbstractTypeMacro(vtkDeviceLinkOperator, vtkLinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Get ready to compute: for OpenGL, make or find a context. Returns false when that cannot be
   * done, never aborts, and reports nothing through vtkErrorMacro; `reason` then says in one
   * sentence why and what to install.
   */
  virtual bool Open(std::string& reason) = 0;

  /// After Open: true on a real GPU, false where the device is a software renderer, which Eigen on
  /// the CPU beats.
  virtual bool IsHardware() = 0;

protected:
  vtkDeviceLinkOperator();
  ~vtkDeviceLinkOperator() override;

  /// To be called now and then where Initialize takes long, in no state that an observer of
  /// progress must not meet: the filter that initialises the operator tells its progress, and
  /// leaves by an exception where it is aborted.
  static void Beat();

private:
  vtkDeviceLinkOperator(const vtkDeviceLinkOperator&) = delete;
  void operator=(const vtkDeviceLinkOperator&) = delete;
};

#endif
