// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Triangles, and boxes around them in a binary tree, as RGBA texels for
 * vtkLightTransportTracingTree.glsl: first the boxes, two texels each, in the order of a walk that
 * turns to the first child first:
 *
 *   lower corner, box to go on with where a ray misses this one (the number of boxes at the end)
 *   upper corner, first triangle (-1 where children follow)
 *
 * so that a ray needs no stack (B. Smits, Efficiency issues for ray tracing, 1998). Then the
 * triangles, three texels each: a corner, and 1 at the first corner of the last triangle of a box,
 * the number of the body at the second one.
 */
#ifndef TriangleTree_h
#define TriangleTree_h

#include <array>
#include <vector>

namespace LightTransport
{
class TriangleTree
{
public:
  using Corner = std::array<float, 3>;
  struct Triangle
  {
    std::array<Corner, 3> Corners = {};
    int Body = 0; ///< that it is of
  };

  explicit TriangleTree(std::vector<Triangle> triangles);

  const std::vector<float>& GetTexels() const { return this->Texels; }
  int GetNumberOfBoxes() const { return this->NumberOfBoxes; }

private:
  struct Box
  {
    Corner Lower;
    Corner Upper;

    void Add(const Corner& corner);
    void Add(const Triangle& triangle);
    void Add(const Box& box);
    int GetLongestAxis() const;
    float GetSurface() const;
  };
  using Place = std::vector<Triangle>::iterator;

  static Box MakeEmptyBox();
  static Corner GetMiddle(const Triangle& triangle);
  static Box GetBox(Place first, Place last);
  static Place Divide(Place first, Place last);
  void AddBoxes(Place first, Place last);

  std::vector<Triangle> Triangles;
  std::vector<float> Texels;
  int NumberOfBoxes = 0;
  float Spare = 0.0f; ///< that boxes are larger by
};
} // namespace LightTransport

#endif
