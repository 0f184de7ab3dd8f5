// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkLinkOperator
 * @brief applies the links between patches, y = L G R x, and the little vector algebra that solvers
 * need beside it
 *
 * One operator serves radiosity, which iterates, and subsurface scattering, which applies the links
 * once. G is a vtkExchange; L and R are diagonal scalings. Vectors have one value per patch
 * and band and live in numbered slots where the operator computes: in memory for
 * vtkCPULinkOperator, in textures on the GPU for vtkOpenGLLinkOperator. So a solver written
 * against this interface runs on either without moving a vector per iteration; only what GetVector
 * asks for, and one number per band from Dot and MaxNorm, is read back.
 *
 * Slots are small integers chosen by the caller; a slot comes into being when it is first written.
 * Every method but the getters returns false after an error, which has been reported with
 * vtkErrorMacro by then.
 *
 * With an exchange in several parts (ranks of a parallel run) Multiply returns the sum over all
 * parts on every rank.
 */
#ifndef vtkLinkOperator_h
#define vtkLinkOperator_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkObject.h"

class vtkExchange;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkLinkOperator : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkLinkOperator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Take the exchange (uploading it where the operator has memory of its own) and set the number of
   * bands of all vectors. An operator that does not apply this form of exchange says so and returns
   * false. The number of bands must be a multiple of the number of kernels: band b uses kernel
   * b % kernels, so several vectors that share the links may lie side by side.
   */
  virtual bool Initialize(vtkExchange* exchange, int numberOfBands) = 0;

  /// Drop the exchange, all vectors and whatever resources hold them.
  virtual void Release() = 0;

  /// What the operator computes on, for people: "CPU", "OpenGL (llvmpipe ...)".
  virtual const char* GetDeviceName() = 0;

  /// True when vectors hold about 7 digits: a solver then corrects its result with residuals
  /// computed in double precision.
  virtual bool IsSinglePrecision() = 0;

  ///@{
  /// Copy a vector in or out: values[patch * NumberOfBands + band].
  virtual bool SetVector(int slot, const double* values) = 0;
  virtual bool GetVector(int slot, double* values) = 0;
  ///@}

  /// y = G x. The slots must differ.
  virtual bool Multiply(int y, int x) = 0;

  /// z = a x + b y, with a and b per band. z may be x or y.
  virtual bool Combine(int z, const double* a, int x, const double* b, int y) = 0;

  /// z = x y, element by element. z may be x or y.
  virtual bool Scale(int z, int x, int y) = 0;

  /// result[band] = sum over the patches of x y.
  virtual bool Dot(int x, int y, double* result) = 0;

  /// result[band] = largest |x|.
  virtual bool MaxNorm(int x, double* result) = 0;

  /// y = L G R x, the scalings given as slots. The slot `scratch` is overwritten; it and y must
  /// differ from x.
  bool Apply(int y, int left, int right, int x, int scratch);

  vtkGetMacro(NumberOfPatches, vtkIdType);
  vtkGetMacro(NumberOfBands, int);

protected:
  vtkLinkOperator();
  ~vtkLinkOperator() override;

  vtkIdType NumberOfPatches = 0;
  int NumberOfBands = 0;

private:
  vtkLinkOperator(const vtkLinkOperator&) = delete;
  void operator=(const vtkLinkOperator&) = delete;
};

#endif
