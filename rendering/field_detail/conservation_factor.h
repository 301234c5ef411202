/// @file conservation_factor.h
/// The factor that restores the total extinction of a group of media after its detail has eroded it.
///
/// @formula detail-conservation
/// Erosion keeps the total extinction only in the mean over all possible noise. For the actual noise of an
/// effect, a factor corrects the total.
///
/// symbol   unit   meaning
///   x_i, r_i m    center and radius of ball i
///   K_i      m2   its extinction cross section
///   k        1/m  summed extinction of all balls
///   g        1    share of k that detail leaves at a point: n g of field-detail
///   d_sj,q_j 1    nodes of set s, and weights, of a quadrature over a ball weighted by its kernel
///   u_is     1    rank of set s = 0..3 of ball i: (s + random number 0..1 of the ball's id) / 4
///   N, M     1    number of balls; approximate upper limit of the number of sampled sets
///   f        1    factor, the same at every point of the group
/// @derivation
///   The extinction is a sum over balls. So the integral of k g is a sum of means of g over balls:
///       integral of k g = sum over i of K_i (mean of g over ball i by its kernel)              (1)
///   The factor is the total extinction over the eroded total:
///       f = clamp(sum_is w_is K_i / sum_is w_is K_i sum_j q_j g(x_i + r_i d_sj), 1/4, 4)       (2)
///   Nodes and noise coordinates both move with their balls. So g at a node changes only as slowly as the
///   noise is renewed, and f does not flicker. Each ball has four sets s of nodes. If there are many balls,
///   fewer sets are sampled. The weight of a set changes continuously with N:
///       w_is = sat((p - u_is) / (p / 10)), p = (10 / 9) M / (4 N)                              (3)
///   Lumps smaller than a fifth of the largest are replaced by their mean, equation (7) of field-detail,
///   because there are enough of them to average out.
/// @source    own; the nodes in r^2 are Gauss nodes for the kernel's weight r^2 (1 - r^2)^2: moments up to
///            the third are exact
/// @deviation none
/// @valid     any balls; f = 4 without balls, and if the eroded total is 0
/// @accuracy  the total extinction of the measured effects of the library is kept within 4 %, see
///            `fx accuracy detail`
/// @tests     tests/rendering/view/test_conservation_factor.cpp
#pragma once

#include "rendering/field_detail/blob_detail.h"
#include "rendering/lights/medium_caster.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A ball of medium with the data for its detail.
struct DetailedCaster
{
    MediumCaster ball;
    std::array<glm::vec3, 2> carried; ///< [cell] offsets of the noise coordinates, see BlobDetail::carried()
    uint64_t id;                      ///< id of the ball, constant during its life
};

/// Computes the factor f of formula detail-conservation. The memory is kept from call to call. Threads: one
/// at a time.
class ConservationFactor
{
public:
    /// [1] Least factor. Smaller factors would make dense lumps look like mist.
    static constexpr float kMin = 0.25f;
    /// [1] Largest factor. Larger factors would make remnants of thin medium look solid.
    static constexpr float kMax = 4.0f;

    explicit ConservationFactor(std::pmr::memory_resource* memory);

    /// [1] The factor f of formula detail-conservation, kMin .. kMax; 1 for a group that is not conserved.
    /// Equal input gives bit-identical results.
    /// @param balls all balls of the group, visible or not
    float of(const GroupDetail& detail, std::span<const DetailedCaster> balls);

private:
    struct Cells
    {
        glm::vec3 low{0.0f};  ///< [m]
        glm::vec3 side{1.0f}; ///< [m] sides of a cell, > 0
    };
    static glm::ivec3 cellAt(const Cells& cells, const glm::vec3& point);
    void sortIntoCells(std::span<const DetailedCaster> balls);
    float meanShare(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                    const MediumCaster& ball, size_t set) const;
    float shareAt(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                  const glm::vec3& point) const;

    Cells cells_;
    std::pmr::vector<float> thinning_;   ///< [1] symbol v of formula field-detail, for each ball
    std::pmr::vector<uint32_t> starts_;  ///< for each cell: index of its first entry in inCells_
    std::pmr::vector<uint32_t> inCells_; ///< indices of balls, sorted by cell
};

} // namespace fx::render
