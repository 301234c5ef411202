/// @file stochastic_simplification.h
/// Stochastic simplification [CHPR07] of far effects: a subset of particles, meshes and trails is drawn,
/// enlarged or more opaque, so that the total coverage is preserved.
///
/// A particle stays in one row for its lifetime, and a trail stays in one strip of a ribbon. The rank is a
/// function of the index of the row or strip. So the subset does not flicker: while an effect keeps its size
/// on the picture, a particle is drawn either for its whole lifetime or never.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/view_block.h"
#include "rendering/lod/level_of_detail.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Number of elements that rows draw without level of detail.
struct DrawnRows
{
    uint32_t pieces = 0; ///< number of particles with a radius above 0, or of pieces of strips
    uint32_t wholes = 0; ///< number of whole particles or strips
};
DrawnRows countDrawn(const base::SnapshotGroup& group, uint32_t first, uint32_t count, bool isRibbon);

/// Range of the rows of a group that belong to one effect. The level of detail is computed for each effect
/// separately.
struct RowPart
{
    base::GroupInfo info; ///< info of the effect's group, with the placement in the newer snapshot
    uint32_t first, count;
};

/// The shape that is drawn for a row.
enum class RowShape : uint8_t
{
    Card, ///< a sprite or mesh of any opacity
    Body, ///< an opaque sprite or mesh: its size can change, but not its opacity
    Strip,
    SolidStrip, ///< an opaque ribbon: its width can change, but not its opacity
};

/// Factors of size and opacity of a row. Both are 1 if all rows are drawn.
struct RowFactors
{
    float size;    ///< [1] factor of the radius, or of the half width of a strip
    float opacity; ///< [1] factor of the opacity
};

/// @formula lod-rows
/// Size and opacity of the kept particles with which they cover the picture as all particles would.
///
/// symbol  unit   meaning
///   N      1     number of particles at random positions in an area S
///   A, a   m2, 1 area and opacity of one particle on the picture
///   w, m   1     weight of a particle, and its mean over all particles: formula lod-weight
///   g      1     factor of the area
///   T      1     transmittance of a ray
///
/// @derivation
///   The number of particles that a ray meets is Poisson distributed with the mean N A / S, so
///       E[T]   = sum over n of P(n) (1 - a)^n = exp(-a N A / S)                              (1)
///       E[T^2] = exp(-(1 - (1 - a)^2) N A / S)                                               (2)
///   With m N particles of area A / m, both are the same: larger areas alone keep mean and variance. If g is
///   limited to less than 1 / m, and for particles with w < 1, the opacity
///       a' = a w / (m g),   g = min(1 / m, limit)                                            (3)
///   keeps (1), that is the expected sum of a A over all particles. Opaque elements keep their opacity; their
///   area is
///       A' = A w g                                                                           (4)
///   For a strip, g is the factor of its half width; otherwise it is the factor of the squared radius. A long
///   sprite is enlarged in width only, until it is a square, so that streaks keep their length.
///
/// @source    [CHPR07] for drawing a share of the elements with a larger area; (1)-(2) follow from the
///            generating function of the Poisson distribution
/// @deviation g is limited as in formula lod-weight; the drawn opacity is at most 1. With (4), opaque
///            elements with g < 1 / m cover less than all elements would; this occurs only where many
///            elements overlap
/// @valid     particles whose positions are independent; for additive blending, the expected light is exact
/// @accuracy  factors are rounded to binary16 for drawing: at most 2^-11 of their value
/// @tests     tests/rendering/view/test_stochastic_simplification.cpp
///            tests/rendering/view/test_thinned_particles.cpp
RowFactors rowFactors(const LodLevel& level, float rank, float pixels, RowShape shape);

struct SimplificationInputs
{
    const base::SnapshotGroup* rows;
    /// One range of rows for each effect. Empty: all rows belong to the effect of the group.
    std::span<const RowPart> parts;
    /// Placement of the group at the moment of the frame, relative to the eye.
    base::Placement place;
    RowShape shape;
    const CameraGeometry* camera;
    float pixelsPerSlope; ///< [pixel] size on the picture of an object of 1 m at a distance of 1 m
};

/// Computes the factors of all rows.
/// @param outFactors for each row, the factors of size (lower half) and opacity (upper half) as binary16. 0:
///     the row is not drawn. Not written if all rows are drawn unchanged
/// @param ioLeftOut increased by the number of omitted particles or pieces of strips
/// @return true if any row is omitted or changed
bool simplifyRows(const SimplificationInputs& in, LevelOfDetail& lod, std::pmr::vector<uint32_t>& outFactors,
                  uint64_t& ioLeftOut);

} // namespace fx::render
