//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The error test of dynamic links: what becomes of a pair of a receiver and a sender, both slots of a tree (RefinementTables.h). A
// receiver that is a patch decides as ScatteringReceiver and ScatteringClusters do; one that is a node where all patches below decide
// alike, by bounds, and is divided where they do not.
#extension GL_ARB_shader_bit_encoding : require

// WIDTH_BITS: of the number of texels in a line. PLACE_BITS: of a float that are a place in a piece of the profile. SINGULAR.
//VTK::LightTransport::Define

uniform sampler2D places[6];
uniform sampler2D pieces[1];  // slots
uniform sampler2D profile[1]; // three texels a piece
uniform sampler2D bounds[2];  // level * pieceCount + piece
uniform int nodes;
uniform int firstPiece;
uniform int pieceCount;
uniform float squaredCore;
uniform vec3 decays;
uniform float leaveOut;
uniform float relativeTolerance;
uniform float tolerancePerArea;
uniform float widestSpread2;
uniform float errorOfCorrection;

in vec4 entry; // receiver, sender, state

out vec4 tested; // receiver, sender, state of what follows, action
out vec4 value;  // integral over the sender; 1 where it is a link's
out vec4 deviation2;

// States, of which those from LINK on are decided for all patches below the receiver.
const int LOOKING = 0; // whether the sender's pieces stand for it
const int BELOW = 1;   // below one for which they do
const int LINK = 2;
const int DIVIDED = 3;
const int NEAR = 4;
const int LEFT_OUT = 5;

const int TAKE = 0;
const int DIVIDE_RECEIVER = 1;
const int DIVIDE_SENDER = 2;
const int TAKE_AND_DIVIDE = 3; // the sender; the receiver keeps it as DIVIDED

const float SMALLEST_SQUARE = 1e-37;

struct Slot
{
  vec3 center;
  vec3 rest; // of the center, beyond single precision
  float area;
  float moment;
  float radius;
  float first; // patch
  float last;
  float limit;
};

// Over the pieces of a sender, each as much as its area.
struct Sums
{
  vec3 rough;    // the profile at the center of all
  vec3 offset;   // what the mean of the profile at their centers differs
  vec3 variance; // of the profile at their centers
  vec3 slope2;   // half of its squared slope there: the change over a piece, per moment
  vec3 change;   // by the moments of the pieces
  bool isSmooth; // the pieces are what they are at their centers
};

ivec2 GetPlace(int texel)
{
  return ivec2(texel & ((1 << WIDTH_BITS) - 1), texel >> WIDTH_BITS);
}

Slot GetSlot(int slot)
{
  ivec2 place = GetPlace(slot);
  vec4 a = texelFetch(places[0], place, 0);
  vec4 b = texelFetch(places[1], place, 0);
  vec4 c = texelFetch(places[2], place, 0);
  return Slot(a.xyz, b.xyz, a.w, b.w, c.x, c.y, c.z, c.w);
}

float GetDistance2(vec3 center, vec3 rest, vec3 otherCenter, vec3 otherRest)
{
  vec3 difference = (center - otherCenter) + (rest - otherRest);
  return dot(difference, difference);
}

int GetPiece(float distance2)
{
  return clamp((floatBitsToInt(distance2 + squaredCore) >> PLACE_BITS) - firstPiece, 0, pieceCount - 1);
}

vec3 GetProfile(float distance2, out vec3 derivative)
{
  int bits = floatBitsToInt(distance2 + squaredCore);
  int piece = 3 * GetPiece(distance2);
  float at = float(bits & ((1 << PLACE_BITS) - 1)) / float(1 << PLACE_BITS);
  float size = intBitsToFloat(bits & ~((1 << 23) - 1)) / float(1 << (23 - PLACE_BITS));
  vec3 c0 = texelFetch(profile[0], GetPlace(piece), 0).xyz;
  vec3 c1 = texelFetch(profile[0], GetPlace(piece + 1), 0).xyz;
  vec3 c2 = texelFetch(profile[0], GetPlace(piece + 2), 0).xyz;
  derivative = (c1 + 2.0 * at * c2) / size;
  return max(c0 + at * (c1 + at * c2), 0.0);
}

vec3 GetProfile(float distance2)
{
  vec3 derivative;
  return GetProfile(distance2, derivative);
}

float GetLargest(vec3 bands)
{
  return max(max(bands.x, bands.y), bands.z);
}

// Of the profile between two balls with a gap between them.
float GetBound(float gap)
{
  float positive = max(gap, 0.0);
  return GetLargest(GetProfile(positive * positive));
}

bool IsNarrow(float distance2, float size2, vec3 there, vec3 slope)
{
  bvec3 isFlat = lessThanEqual(size2 * decays * decays, vec3(widestSpread2));
  bvec3 isThere = greaterThan(there, vec3(0.0));
  return all(lessThanEqual(size2 * slope * slope, widestSpread2 * there * there)) &&
#if SINGULAR
    size2 <= widestSpread2 * distance2 &&
#endif
    (isThere.x || isFlat.x) && (isThere.y || isFlat.y) && (isThere.z || isFlat.z);
}

// ScatteringClusters::Look, from a point with a moment of its own. Differences are taken from the value at the center, so that single
// precision is enough.
Sums Look(Slot here, float hereMoment, Slot there, vec4 below)
{
  Sums sums = Sums(GetProfile(GetDistance2(here.center, here.rest, there.center, there.rest)), vec3(0.0), vec3(0.0),
    vec3(0.0), vec3(0.0), true);
  for (int k = int(below.z); k < int(below.w); ++k)
  {
    ivec2 place = GetPlace(int(texelFetch(pieces[0], GetPlace(k), 0).x));
    vec4 a = texelFetch(places[0], place, 0);
    vec4 b = texelFetch(places[1], place, 0);
    float weight = a.w / there.area;
    float distance2 = GetDistance2(here.center, here.rest, a.xyz, b.xyz);
    vec3 derivative;
    vec3 found = GetProfile(distance2, derivative);
    vec3 slope = 2.0 * sqrt(distance2) * derivative;
    sums.isSmooth = sums.isSmooth && IsNarrow(distance2, 0.5 * (hereMoment + b.w), found, slope);
    vec3 difference = found - sums.rough;
    sums.offset += weight * difference;
    sums.variance += weight * difference * difference;
    sums.slope2 += 0.5 * weight * slope * slope;
    sums.change += 0.5 * weight * b.w * slope * slope;
  }
  sums.variance = max(sums.variance - sums.offset * sums.offset, 0.0);
  return sums;
}

// What the moments that pieces leave add to a mean, of what it differs from the value at the center.
float GetCorrection(float hereMoment, Slot there, float piecesMoment)
{
  float within = piecesMoment + hereMoment;
  return within / max(there.moment - piecesMoment, within);
}

void SetEstimate(Slot here, Slot there, float piecesMoment, Sums sums)
{
  vec3 mean = sums.rough + sums.offset;
  vec3 correction = GetCorrection(here.moment, there, piecesMoment) * sums.offset;
  vec3 change = here.moment * sums.slope2 + sums.change;
  vec3 spread2 = change / max(sums.variance + mean * mean, SMALLEST_SQUARE);
  vec3 error = abs(correction) * min(errorOfCorrection * spread2, 1.0);
  vec3 corrected = max(mean + correction, 0.0);
  bool isFactor = sums.isSmooth && all(lessThanEqual(error, relativeTolerance * corrected + vec3(tolerancePerArea)));
  // Squares of the mean and of the corrected one differ by much less than they are.
  vec3 variance = sums.variance + change + (mean - corrected) * (mean + corrected);
  value = vec4(there.area * corrected, isFactor ? 1.0 : 0.0);
  deviation2 = vec4(there.area * there.area * max(variance, 0.0), 0.0);
}

void Act(int action, int state)
{
  tested = vec4(entry.xy, float(state), float(action));
}

// For one patch.
void Decide(int state, Slot here, int sender, Slot there)
{
  bool isPatch = sender >= nodes;
  if (there.first <= here.first && here.last <= there.last)
  {
    Act(isPatch ? TAKE : DIVIDE_SENDER, isPatch ? NEAR : LOOKING);
    return;
  }
  float gap = sqrt(GetDistance2(here.center, here.rest, there.center, there.rest)) - here.radius - there.radius;
  if (GetBound(gap) < leaveOut)
  {
    Act(TAKE, LEFT_OUT);
    return;
  }
  if (isPatch)
  {
    Act(TAKE, state == BELOW ? LINK : NEAR);
    return;
  }
  Sums sums = Look(here, here.moment, there, texelFetch(places[3], GetPlace(sender), 0));
  if (state == LOOKING && !sums.isSmooth)
  {
    Act(DIVIDE_SENDER, LOOKING);
    return;
  }
  SetEstimate(here, there, texelFetch(places[5], GetPlace(sender), 0).x, sums);
  bool divides = there.limit < 0.0 || GetLargest(deviation2.xyz) > there.limit * there.limit;
  Act(divides ? (state == BELOW ? DIVIDE_SENDER : TAKE_AND_DIVIDE) : TAKE, divides ? BELOW : LINK);
}

// What holds of the profile wherever a piece of the sender is seen from a patch of the receiver.
struct Range
{
  vec3 slope;     // at most
  vec3 curvature; // likewise
  vec2 fall;      // of the logarithm, largest of the bands: at least, at most
};

Range GetRange(float nearest, float farthest)
{
  int first = GetPiece(nearest * nearest);
  int count = GetPiece(farthest * farthest) - first + 1;
  int level = (floatBitsToInt(float(count)) >> 23) - 127;
  int begin = level * pieceCount + first;
  int end = begin + count - (1 << level);
  vec4 slopes = max(texelFetch(bounds[0], GetPlace(begin), 0), texelFetch(bounds[0], GetPlace(end), 0));
  vec4 a = texelFetch(bounds[1], GetPlace(begin), 0);
  vec4 b = texelFetch(bounds[1], GetPlace(end), 0);
  return Range(slopes.xyz, max(a.xyz, b.xyz), vec2(min(a.w, b.w), slopes.w));
}

// What squares with (mean + correction)^2 differ from those with mean^2, where this is not below 0.
vec3 GetDifference(vec3 mean, vec3 correction)
{
  vec3 bounded = max(correction, -mean);
  return -bounded * (2.0 * mean + bounded);
}

// Between which squared deviations, over the squared area, patches below the receiver are: what it is from the receiver's center, and
// how fast that may change. Roots of sums of squares change no faster than what is squared.
void BoundDeviation(Slot here, vec3 moments, Slot there, float piecesMoment, Sums sums, Range range, out vec3 least, out vec3 most)
{
  float between = max(there.moment - piecesMoment, 0.0);
  vec3 change = moments.z * range.curvature;
  vec3 ofCenters = sqrt(between) * change;
  vec3 deviation = sqrt(sums.variance);
  vec3 inside = sqrt(moments.x * sums.slope2 + sums.change);
  vec3 outside = sqrt(moments.y * sums.slope2 + sums.change);
  vec3 leastInside = max(inside - sqrt(0.5 * (moments.x + piecesMoment)) * change, 0.0);
  vec3 mostInside = outside + sqrt(0.5 * (moments.y + piecesMoment)) * change;

  vec3 largest = 0.5 * between * range.curvature;
  vec3 leastOffset = max(sums.offset - ofCenters, -largest);
  vec3 mostOffset = min(sums.offset + ofCenters, largest);
  float leastFactor = GetCorrection(moments.x, there, piecesMoment);
  float mostFactor = GetCorrection(moments.y, there, piecesMoment);
  vec3 leastCorrection = min(leastFactor * leastOffset, mostFactor * leastOffset);
  vec3 mostCorrection = max(leastFactor * mostOffset, mostFactor * mostOffset);
  vec3 mean = sums.rough + sums.offset;
  vec3 leastMean = max(mean - moments.z * range.slope, 0.0);
  vec3 mostMean = mean + moments.z * range.slope;
  vec3 leastDifference = min(GetDifference(leastMean, mostCorrection), GetDifference(mostMean, mostCorrection));
  vec3 mostDifference = max(GetDifference(leastMean, leastCorrection), GetDifference(mostMean, leastCorrection));

  vec3 leastOfCenters = max(deviation - ofCenters, 0.0);
  vec3 mostOfCenters = deviation + ofCenters;
  least = max(leastOfCenters * leastOfCenters + leastInside * leastInside + leastDifference, 0.0);
  most = max(mostOfCenters * mostOfCenters + mostInside * mostInside + mostDifference, 0.0);
}

// For all patches below a node that holds none of the sender's.
void DecideForAll(int state, int receiver, Slot here, int sender, Slot there)
{
  bool isPatch = sender >= nodes;
  float distance = sqrt(GetDistance2(here.center, here.rest, there.center, there.rest));
  if (GetBound(distance - here.radius - there.radius) < leaveOut)
  {
    Act(DIVIDE_RECEIVER, LEFT_OUT);
    return;
  }
  if (GetBound(distance + here.radius - there.radius) < leaveOut)
  {
    Act(DIVIDE_RECEIVER, state);
    return;
  }
  if (isPatch)
  {
    Act(DIVIDE_RECEIVER, state == BELOW ? LINK : NEAR);
    return;
  }
  vec3 moments = texelFetch(places[4], GetPlace(receiver), 0).xyz;
  vec3 ofPieces = texelFetch(places[5], GetPlace(sender), 0).xyz;
  float nearest = max(distance - moments.z - ofPieces.z, 0.0);
  float farthest = distance + moments.z + ofPieces.z;
  Range range = GetRange(nearest, farthest);
  if (state == LOOKING)
  {
    float leastSize2 = 0.5 * (moments.x + ofPieces.y);
    float mostSize2 = 0.5 * (moments.y + ofPieces.y);
    bool isWide = leastSize2 * range.fall.x * range.fall.x > widestSpread2;
    bool isNarrow = mostSize2 * range.fall.y * range.fall.y < widestSpread2 &&
      (all(greaterThan(GetProfile(farthest * farthest), vec3(0.0))) || mostSize2 * GetLargest(decays * decays) < widestSpread2);
#if SINGULAR
    isWide = isWide || leastSize2 > widestSpread2 * farthest * farthest;
    isNarrow = isNarrow && mostSize2 < widestSpread2 * nearest * nearest;
#endif
    if (isWide || !isNarrow)
    {
      Act(isWide ? DIVIDE_SENDER : DIVIDE_RECEIVER, LOOKING);
      return;
    }
  }
  bool divides = there.limit < 0.0;
  bool links = false;
  if (!divides)
  {
    vec3 least;
    vec3 most;
    Sums sums = Look(here, moments.y, there, texelFetch(places[3], GetPlace(sender), 0));
    BoundDeviation(here, moments, there, ofPieces.x, sums, range, least, most);
    float limit = there.limit / there.area;
    divides = GetLargest(least) > limit * limit;
    links = GetLargest(most) < limit * limit;
  }
  if (divides)
  {
    Act(state == BELOW ? DIVIDE_SENDER : TAKE_AND_DIVIDE, BELOW);
    return;
  }
  Act(DIVIDE_RECEIVER, links ? LINK : state);
}

void main()
{
  int receiver = int(entry.x);
  int sender = int(entry.y);
  int state = int(entry.z);
  value = vec4(0.0);
  deviation2 = vec4(0.0);
  Slot here = GetSlot(receiver);
  Slot there = GetSlot(sender);
  if (receiver >= nodes)
  {
    if (state < LINK)
    {
      Decide(state, here, sender, there);
      return;
    }
    if (sender < nodes && state <= DIVIDED)
    {
      Sums sums = Look(here, here.moment, there, texelFetch(places[3], GetPlace(sender), 0));
      SetEstimate(here, there, texelFetch(places[5], GetPlace(sender), 0).x, sums);
    }
    Act(TAKE, state);
    return;
  }
  if (state >= LINK)
  {
    Act(DIVIDE_RECEIVER, state);
  }
  else if (sender < nodes && there.first <= here.first && here.last <= there.last)
  {
    Act(DIVIDE_SENDER, state);
  }
  else if (there.first < here.last && here.first < there.last)
  {
    Act(DIVIDE_RECEIVER, state);
  }
  else
  {
    DecideForAll(state, receiver, here, sender, there);
  }
}
