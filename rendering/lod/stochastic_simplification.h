/// @file stochastic_simplification.h
/// Stochastic simplification [CHPR07] of far effects: a subset of particles, meshes and trails is drawn,
/// enlarged or more opaque, so that the total coverage is preserved.
///
/// A row of particles is the same particle for life, and so is a strip of a ribbon: its rank is a function of
/// the number of the row or strip. So the subset does not flicker, and a particle is drawn for its whole
/// lifetime while its effect keeps its size on the picture.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/view_block.h"
#include "rendering/lod/level_of_detail.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Shape and blending of rows.
struct DrawnRows
{
    uint32_t pieces = 0; ///< particles whose radius is above 0, or pieces of strips
    uint32_t wholes = 0; ///< of which some have to stay: the particles, or the strips
};
DrawnRows countDrawn(const base::SnapshotGroup& group, uint32_t first, uint32_t count, bool isRibbon);

/// Rows of a group that belong to one effect, which has its own level.
struct RowPart
{
    base::GroupInfo info; ///< of the group of the effect; its placement is that of the newer snapshot
    uint32_t first, count;
};

/// Drawn shape of a row.
enum class RowShape : uint8_t
{
    Card, ///< a sprite or mesh of any opacity
    Body, ///< a sprite or mesh that hides: it can be smaller, but not fainter
    Strip,
    SolidStrip, ///< a ribbon that hides
};

/// By how much a row is larger, and its opacity more, than without a level of detail.
struct RowFactors
{
    float size;    ///< [1] factor of the radius, or of the half width of a strip
    float opacity; ///< [1] factor
};

/// @formula lod-rows
/// Size and opacity of the particles that are kept, so that the picture is covered as by all.
///
/// symbol  unit   meaning
///   N      1     particles, strewn at random over an area S
///   A      m2    area of one on the picture, opaque to the share a of light
///   w, m   1     share of a particle that is drawn, and its mean over all: formula lod-weight
///   g      1     growth of the area
///   T      1     light that passes along a ray
///
/// @derivation
///   The number of particles that a ray meets is Poisson distributed with the mean N A / S, so
///       E[T]   = sum over n of P(n) (1 - a)^n = exp(-a N A / S)                              (1)
///       E[T^2] = exp(-(1 - (1 - a)^2) N A / S)                                               (2)
///   Of m N particles with the area A / m both are the same: growth alone keeps mean and variance. Where
///   growth is limited to g < 1 / m, and for those on the border,
///       a' = a w / (m g),   g = min(1 / m, limit)                                            (3)
///   keeps (1), the sum of a A over all particles on average. What hides cannot be fainter; its area is
///       A' = A w g                                                                           (4)
///   A strip grows in width only: g is the factor of its half width, for others of the radius squared. A long
///   sprite grows across until it is a square, so that streaks keep their length.
///
/// @source    [CHPR07] for drawing a share of the elements with a larger area; (1)-(2) are ours, by the
///            generating function of the Poisson distribution
/// @deviation the limits of growth are those of formula lod-weight; a' is at most 1 where it covers; with (4)
///            what grows less than 1 / m covers less, which happens only where bodies overlap many times
/// @valid     particles without order among each other; additive ones keep their light exactly, on average
/// @accuracy  factors are rounded to binary16 for drawing: at most 2^-11 of their value
/// @tests     tests/rendering/view/test_stochastic_simplification.cpp
///            tests/rendering/view/test_thinned_particles.cpp
RowFactors rowFactors(const LodLevel& level, float rank, float pixels, RowShape shape);

struct SimplificationInputs
{
    const base::SnapshotGroup* rows;
    std::span<const RowPart> parts; ///< empty: all rows are of the group's own effect
    base::Placement place;          ///< of the group at the moment of the frame, relative to the eye
    RowShape shape;
    const CameraGeometry* camera;
    float pixelsPerSlope; ///< [pixel] at distance 1 for 1
};

/// Computes the factors of all rows.
/// @param outFactors by row: two binary16 numbers, size in the lower half and opacity; 0: not drawn.
///         Untouched when all rows are drawn unchanged
/// @param ioLeftOut increased by the number of omitted particles or pieces of strips
/// @return whether any row is omitted or changed
bool simplifyRows(const SimplificationInputs& in, LevelOfDetail& lod, std::pmr::vector<uint32_t>& outFactors,
                  uint64_t& ioLeftOut);

} // namespace fx::render
