/// @file conservation_factor.h
/// The factor that gives a group of media back the extinction that its detail has eroded.
///
/// @formula detail-conservation
/// Erosion by noise keeps the mean over all noise only; one effect at one time has the noise that is there.
///
/// symbol   unit   meaning
///   x_i, r_i m    middle and radius of ball i
///   K_i      m2   its extinction cross section
///   k        1/m  summed extinction of all balls
///   g        1    share of k that detail leaves at a point: n g of field-detail
///   d_sj,q_j 1    nodes of set s and weights of a quadrature over a ball, by the weight of its kernel
///   u_is     1    rank of set s = 0..3 of ball i: (s + random number 0..1 of the ball's id) / 4
///   N, M     1    count of the balls, count of sets that are sampled at most, about
///   f        1    factor, the same at every point of the group
/// @derivation
///   The extinction is a sum over balls, so that its integral with the share g is a sum of means over balls:
///       integral of k g = sum over i of K_i (mean of g over ball i by its kernel)              (1)
///   The factor is the whole over what is left of it:
///       f = clamp(sum_is w_is K_i / sum_is w_is K_i sum_j q_j g(x_i + r_i d_sj), 1/4, 4)       (2)
///   The nodes follow their balls, and so do the coordinates of the noise: g changes there as slowly as the
///   noise is renewed, and f does not pulse. Each ball has four sets s of nodes; of many balls fewer sets are
///   sampled. They come and go by a weight, as N changes:
///       w_is = sat((p - u_is) / (p / 10)), p = (10 / 9) M / (4 N)                              (3)
///   Lumps that are finer than an eighth of the largest are not sampled: their share is its mean, equation
///   (7) of field-detail. There are so many of them that their mean is what is there.
/// @source    own; the nodes in r^2 are Gauss's for the kernel's weight r^2 (1 - r^2)^2: moments up to the
/// third
///            are exact
/// @deviation none
/// @valid     any balls; none give 4, as do those of which nothing is left
/// @accuracy  the extinction of the effects of the library is kept within 2 % at any time, see
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

/// A ball of medium with what its detail needs.
struct DetailedCaster
{
    MediumCaster ball;
    std::array<glm::vec3, 2> carried; ///< [cell] coordinates of both generations, see BlobDetail
    uint64_t id;                      ///< of the ball, while it lives
};

/// Keeps its memory from call to call. Threads: one at a time.
class ConservationFactor
{
public:
    static constexpr float kMin = 0.25f; ///< [1] less would make mist of dense lumps
    static constexpr float kMax = 4.0f;  ///< [1] more would make a solid of what is left of thin medium

    explicit ConservationFactor(std::pmr::memory_resource* memory);

    /// [1] kMin .. kMax. Equal input gives equal bits.
    /// @param balls all of the group, visible or not
    float of(const GroupDetail& detail, std::span<const DetailedCaster> balls);

private:
    struct Cells
    {
        glm::vec3 low{0.0f};  ///< [m]
        glm::vec3 side{1.0f}; ///< [m] of a cell, > 0
    };
    static glm::ivec3 cellAt(const Cells& cells, const glm::vec3& point);
    void sortIntoCells(std::span<const DetailedCaster> balls);
    float meanShare(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                    const MediumCaster& ball, size_t set) const;
    float shareAt(const GroupDetail& detail, std::span<const DetailedCaster> balls,
                  const glm::vec3& point) const;

    Cells cells_;
    std::pmr::vector<float> thinning_;   ///< [1] of each ball
    std::pmr::vector<uint32_t> starts_;  ///< of each cell in inCells_
    std::pmr::vector<uint32_t> inCells_; ///< numbers of balls, in their order
};

} // namespace fx::render
