/// @file medium_details.h
/// Detail of the fields of a medium, as the renderers without a GPU get and evaluate it.
#pragma once

#include "rendering/field_detail/blob_detail.h"
#include "rendering/reference/render/reference_camera.h"
#include "rendering/reference/trace/ball_tree.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace fx::render {

/// The detail of a list of balls. Without groups there is none.
struct MediumDetails
{
    /// Data that all blobs of a group share.
    struct Group
    {
        GroupDetail detail;     ///< relative to `origin`, world axes
        glm::dvec3 origin{0.0}; ///< [m] world
    };
    /// What a ball has.
    struct Ball
    {
        int32_t group = -1;                 ///< number in `groups`; -1: it stays smooth
        std::array<glm::vec3, 2> carried{}; ///< [cell] coordinates of both generations, see BlobDetail
        float temperature = 0.0f;           ///< [K]
        float thinning = 0.0f;              ///< [1] v of field-detail
    };
    std::vector<Group> groups;
    std::vector<Ball> balls;         ///< one for each of the list, or none at all
    int octaves = kMaxDetailOctaves; ///< 1..kMaxDetailOctaves

    bool isGiven() const { return !groups.empty(); }
};

/// Width of the pixels of a picture: noise that is finer than two of them has faded out.
struct PixelWidth
{
    glm::dvec3 forward{0.0, 0.0, -1.0}; ///< unit, the axis of the view
    double perDepth = 0.0;              ///< [1] over the distance along the axis
    double constant = 0.0;              ///< [m] added to it

    PixelWidth() = default;
    PixelWidth(const ReferenceCamera& camera, int height);
    double at(const glm::dvec3& point) const; ///< [m] @param point [m] relative to the eye
};

/// Details of a medium whose balls have been put in another order. Read by any number of threads.
class DetailedMedium
{
public:
    DetailedMedium() = default;
    /// @param tree of the balls, whose order is that of places
    DetailedMedium(const MediumDetails& details, const BallTree& tree, const glm::dvec3& eye,
                   const PixelWidth& pixel);

    bool isGiven() const { return !groups_.empty(); }
    size_t groupCount() const { return groups_.size(); }
    const MediumDetails::Ball& ball(uint32_t place) const { return balls_[place]; }
    int32_t groupOf(uint32_t place) const { return isGiven() ? balls_[place].group : -1; }
    /// [m] size of the largest lumps of a group in the world.
    double lumpSize(size_t group) const;

    /// What detail makes of a group at a point.
    /// @param extinction [1/m] > 0, sum of its balls  @param carried [cell], thinning [1] means of its balls
    MediumDetail at(size_t group, double extinction, const std::array<glm::dvec3, 2>& carried,
                    double thinning, const glm::dvec3& point) const;
    /// [cd/m2] black body of a ball's temperature.
    const glm::vec3& thermal(uint32_t place) const { return thermal_[place]; }
    /// [1/m] what is left of a smooth extinction of at most `most` is no more.
    double maxErodedExtinction(size_t group, double most) const;
    double mostGain(size_t group) const; ///< [1] by which detail multiplies an extinction at most

private:
    struct Group
    {
        GroupDetail detail;
        glm::dvec3 origin; ///< [m] relative to the eye
    };
    std::vector<Group> groups_;
    std::vector<MediumDetails::Ball> balls_; ///< by place
    std::vector<glm::vec3> thermal_;         ///< likewise
    PixelWidth pixel_;
    int octaves_ = kMaxDetailOctaves;
};

/// Sums of the balls at one point, group by group. One for each thread.
class DetailMix
{
public:
    explicit DetailMix(const DetailedMedium& medium) : medium_(medium) {}

    void clear();
    /// @param extinction [1/m] of the ball at the point
    void add(uint32_t place, double extinction);
    /// After all balls of the point.
    void finish(const glm::dvec3& point);
    /// [1] by which the extinction of the ball is multiplied.
    double share(uint32_t place) const
    {
        const int32_t group = medium_.groupOf(place);
        return group < 0 ? 1.0 : sums_[size_t(group)].detail.share;
    }
    /// [1] by which its temperature is multiplied.
    float temperature(uint32_t place) const
    {
        const int32_t group = medium_.groupOf(place);
        return group < 0 ? 1.0f : sums_[size_t(group)].detail.temperature;
    }
    /// [cd/m2] emitted light per optical depth.
    /// @param source without detail
    glm::dvec3 source(uint32_t place, const glm::dvec3& source, const glm::dvec3& albedo) const;

    /// [1/m] of all balls that were added is no more than this left, if add() got upper bounds.
    double maxErodedExtinction() const;

private:
    struct Sum
    {
        double extinction = 0.0;
        std::array<glm::dvec3, 2> carried{};
        double thinning = 0.0;
        MediumDetail detail;
    };
    const DetailedMedium& medium_;
    std::vector<Sum> sums_; ///< of groups
    double smooth_ = 0.0;   ///< [1/m] of balls without detail
};

} // namespace fx::render
