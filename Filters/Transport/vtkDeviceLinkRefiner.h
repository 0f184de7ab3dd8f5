// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDeviceLinkRefiner
 * @brief chooses links of scattered light on a device, if one is registered
 *
 * Which clusters of a body each of its patches receives light from: the tree is walked from its
 * root, and a cluster is divided where a link from it would miss too much of light that varies
 * over it. Receivers divide too: the walk begins with clusters of receivers, which are divided
 * where they do not agree. What the profile over a cluster comes to is known by its pieces, each
 * taken at its centre; where that does not do (a piece is wide beside the profile) the walk goes on
 * down to patches, which are left to the caller.
 *
 * The filters know nothing of OpenGL. New() asks VTK's object factories, quietly, and returns
 * nullptr when no loaded module implements this class; vtkLightTransportRendering does, with
 * vtkOpenGLLinkRefiner.
 */
#ifndef vtkDeviceLinkRefiner_h
#define vtkDeviceLinkRefiner_h

#include "vtkLightTransportFiltersModule.h" // for export macro
#include "vtkObject.h"

#include <array>   // for std::array
#include <cstdint> // for std::uint32_t
#include <memory>  // for std::shared_ptr
#include <string>  // for std::string
#include <vector>  // for std::vector

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDeviceLinkRefiner : public vtkObject
{
public:
  /// May return nullptr: no module with a device refiner is loaded.
  static vtkDeviceLinkRefiner* New();
  vtkAbstractTypeMacro(vtkDeviceLinkRefiner, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  static constexpr int NumberOfBands = 3;
  using Bands = std::array<double, NumberOfBands>;

  /// A cluster or a patch.
  struct Slot
  {
    std::array<double, 3> Center{};
    double Area = 0.0;
    double Moment = 0.0; ///< mean squared distance from the centre
    double Radius = 0.0; ///< of a sphere around the centre that holds it
    /// A link from here may miss as much of light that differs by 1 from its mean; negative where
    /// the cluster is divided whatever it misses.
    double Limit = 0.0;
    ///@{ Patches [First, Last), children (slots), and pieces: places in Body::Pieces.
    int FirstPatch = 0;
    int LastPatch = 0;
    int FirstChild = 0;
    int LastChild = 0;
    int FirstPiece = 0;
    int LastPiece = 0;
    ///@}
  };

  /// The profiles over their totals, as parabolas over pieces of x, the squared distance and
  /// SquaredCore: 2^PieceBits pieces an octave, so that the top bits of x as a float are the piece.
  struct ProfileTable
  {
    double SquaredCore = 0.0;
    int PieceBits = 0;
    std::uint32_t FirstPiece = 0; ///< top bits of the first one
    /// In a coordinate from 0 to 1: what stands for itself, with it, with its square; per piece.
    std::vector<std::array<std::array<float, NumberOfBands>, 3>> Pieces;
    bool IsSingular = false; ///< goes like 1/r at the centre
    Bands Decays{};          ///< by how much logarithms change per length, at most, far out
  };

  /// Nodes of a tree, parents before children, then the patches. In any unit of length.
  struct Body
  {
    int NumberOfNodes = 0;
    std::vector<Slot> Slots;
    std::vector<int> Pieces; ///< slots
    ProfileTable Profile;
    double LeaveOut = 0.0; ///< what is certainly below this much of the profile is left out
    ///@{ What a link's value may be wrong by, of itself and per area of both ends.
    double RelativeTolerance = 0.0;
    double TolerancePerArea = 0.0;
    ///@}
    /// Of the squared spread of a piece: a wider one is not what it is at its centre.
    double WidestSpread2 = 0.0;
    /// Of the correction of a cluster's value by its moments, over the squared spread.
    double ErrorOfCorrection = 0.0;
  };

  enum class Kind : std::uint8_t
  {
    Link,    ///< from a cluster, or from a patch beyond what is near
    Divided, ///< a cluster whose links follow: the first on the way down that its pieces stand for
    Patch,   ///< near: to be integrated
    LeftOut
  };

  /// What a receiver finds on its way. Together with what follows those that are Divided, the parts
  /// of a receiver make up the body. Values and deviations are those of clusters.
  struct Part
  {
    int Receiver = 0; ///< patch
    int Slot = 0;
    Kind What = Kind::Link;
    bool IsFactor = false;                    ///< the value is within the tolerance of a link's
    std::array<float, NumberOfBands> Value{}; ///< integral of the profiles over the slot
    std::array<float, NumberOfBands> Deviation2{}; ///< squared, of what the link may miss
  };

  /**
   * Get ready to compute: for OpenGL, make or find a context. Returns false when that cannot be
   * done, never aborts, and reports nothing through vtkErrorMacro; `reason` then says in one
   * sentence why and what to install.
   */
  virtual bool Open(std::string& reason) = 0;

  /// After Open: true on a real GPU.
  virtual bool IsHardware() = 0;

  /// What computes, for users, such as "OpenGL (llvmpipe ...)".
  virtual const char* GetDeviceName() = 0;

  /// False where the device does not take the body; `reason` then says why, without a full stop.
  virtual bool Initialize(std::shared_ptr<const Body> body, std::string& reason) = 0;

  /// The parts of patches [first, last), in no order; false likewise.
  virtual bool Refine(vtkIdType first, vtkIdType last, std::vector<Part>& parts,
    std::string& reason) = 0;

protected:
  vtkDeviceLinkRefiner();
  ~vtkDeviceLinkRefiner() override;

  /// To be called now and then where Refine takes long, in no state that an observer of progress
  /// must not meet: the filter tells its progress, and leaves by an exception where it is aborted.
  static void Beat();

private:
  vtkDeviceLinkRefiner(const vtkDeviceLinkRefiner&) = delete;
  void operator=(const vtkDeviceLinkRefiner&) = delete;
};

#endif
