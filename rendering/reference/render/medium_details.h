/// @file medium_details.h
/// Detail of the fields of a medium, for renderers without a GPU.
#pragma once

#include "rendering/field_detail/blob_detail.h"
#include "rendering/reference/render/reference_camera.h"
#include "rendering/reference/trace/ball_tree.h"
#include "rendering/volumes/medium_volume.h"
#include "rendering/volumes/volume_place.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fx::render {

/// The detail of a list of balls. Without groups there is no detail. A group may be a volume: voxels replace
/// the sum of its balls, which only say where there is medium. Its detail erodes the voxels.
struct MediumDetails
{
    /// Data that all blobs of a group share.
    struct Group
    {
        /// Parameters of the detail, for positions relative to `origin`, along world axes. Of a volume
        /// without detail, numbers.isGiven() is false.
        GroupDetail detail;
        glm::dvec3 origin{0.0};                               ///< [m] position of the origin in the world
        std::shared_ptr<const MediumVolume> volume = nullptr; ///< null: the group is no volume
        /// Of `volume`, for positions relative to `origin`. Without a volume, only the tint is set.
        GroupVolume place = {};
    };
    /// Data of one ball.
    struct Ball
    {
        int32_t group = -1;                 ///< index in `groups`; -1: the ball has no detail
        std::array<glm::vec3, 2> carried{}; ///< [cell] coordinates of both generations, see BlobDetail
        float temperature = 0.0f;           ///< [K]
        float thinning = 0.0f;              ///< [1] symbol v of formula field-detail
        float largest = 0.0f; ///< [1/m] of a volume: largest extinction in the brick of the ball
    };
    std::vector<Group> groups;
    std::vector<Ball> balls;         ///< detail of each ball of the list; empty if there is no detail
    int octaves = kMaxDetailOctaves; ///< number of octaves of noise, 1..kMaxDetailOctaves

    bool isGiven() const { return !groups.empty(); }
};

/// Removes the detail of all groups. Volumes stay.
void removeNoise(MediumDetails& io);

/// Width of a pixel as a function of distance. Octaves of noise fade out by equation (3) of lump-noise.
struct PixelWidth
{
    glm::dvec3 forward{0.0, 0.0, -1.0}; ///< unit vector, view axis
    double perDepth = 0.0;              ///< [1] width of a pixel divided by the distance along the axis
    double constant = 0.0;              ///< [m] constant part of the width

    PixelWidth() = default;
    PixelWidth(const ReferenceCamera& camera, int height);
    /// [m] Width of a pixel at a point [m] that is relative to the eye.
    double at(const glm::dvec3& point) const;
};

/// The detail of a medium, with its balls in the order of a tree. Threads: any thread may call const
/// functions.
class DetailedMedium
{
public:
    DetailedMedium() = default;
    /// @param tree tree of the balls; a "place" is an index in the order of the tree
    DetailedMedium(const MediumDetails& details, const BallTree& tree, const glm::dvec3& eye,
                   const PixelWidth& pixel);

    bool isGiven() const { return !groups_.empty(); }
    size_t groupCount() const { return groups_.size(); }
    const MediumDetails::Ball& ball(uint32_t place) const { return balls_[place]; }
    int32_t groupOf(uint32_t place) const { return isGiven() ? balls_[place].group : -1; }
    /// [m] size of the largest lumps of a group in the world.
    double lumpSize(size_t group) const;

    /// Evaluates the detail of a group at a point.
    /// @param extinction [1/m] extinction of all balls of the group at the point, > 0
    /// @param carried, thinning [cell], [1] means over the balls of the group, weighted by extinction
    MediumDetail at(size_t group, double extinction, const std::array<glm::dvec3, 2>& carried,
                    double thinning, const glm::dvec3& point) const;
    bool isVolume(size_t group) const { return groups_[group].volume != nullptr; }
    /// The medium of a group that is a volume, at a point. Extinction and light have their factors, and are
    /// eroded by the detail of the volume.
    MediumVolume::Sample volumeAt(size_t group, const glm::dvec3& point) const;
    /// [1/m] Sum over volumes of their largest extinction.
    double largestOfVolumes() const;
    /// [1] Tint of the instance of a group.
    const glm::vec3& tint(size_t group) const { return groups_[group].place.tint; }
    /// [cd/m2] Black-body luminance at the temperature of a ball, without tint.
    const glm::vec3& thermal(uint32_t place) const { return thermal_[place]; }
    /// [1/m] Upper bound of the eroded extinction at points where the smooth extinction is at most `most`
    /// [1/m].
    double maxErodedExtinction(size_t group, double most) const;
    double mostGain(size_t group) const; ///< [1] largest factor by which detail multiplies extinction

    bool hasNoise(size_t group) const { return groups_[group].detail.numbers.isGiven(); }

private:
    double volumeThinning(size_t group, const glm::dvec3& voxel) const;

    struct Group
    {
        GroupDetail detail;
        glm::dvec3 origin; ///< [m] origin of the group's coordinates, relative to the eye
        std::shared_ptr<const MediumVolume> volume;
        GroupVolume place;
    };
    std::vector<Group> groups_;
    std::vector<MediumDetails::Ball> balls_; ///< by place
    std::vector<glm::vec3> thermal_;         ///< by place
    PixelWidth pixel_;
    int octaves_ = kMaxDetailOctaves;
};

/// Sums properties of the balls at one point, by group, and evaluates the resulting detail. Each thread needs
/// its own object.
class DetailMix
{
public:
    explicit DetailMix(const DetailedMedium& medium) : medium_(medium) {}

    void clear();
    /// Adds a ball.
    /// @param extinction [1/m] extinction of the ball at the point
    void add(uint32_t place, double extinction);
    /// Evaluates the detail at the point. Must be called after all balls are added.
    void finish(const glm::dvec3& point);
    /// [1] Factor by which detail multiplies the extinction of a ball.
    double share(uint32_t place) const
    {
        const int32_t group = medium_.groupOf(place);
        return group < 0 ? 1.0 : sums_[size_t(group)].detail.share;
    }
    /// [1] Factor by which detail multiplies the temperature of a ball.
    float temperature(uint32_t place) const
    {
        const int32_t group = medium_.groupOf(place);
        return group < 0 ? 1.0f : sums_[size_t(group)].detail.temperature;
    }
    /// [cd/m2] Emitted light of a ball per optical depth, with detail.
    /// @param source emitted light without detail
    glm::dvec3 source(uint32_t place, const glm::dvec3& source, const glm::dvec3& albedo) const;

    /// [1] Albedo of a ball, or of the volume for which it stands.
    glm::dvec3 albedo(uint32_t place, const glm::dvec3& albedo) const;

    /// [1/m] Upper bound of the eroded extinction of all added balls. Requires that add() was called with
    /// upper bounds.
    double maxErodedExtinction() const;

private:
    struct Sum
    {
        double extinction = 0.0;
        std::array<glm::dvec3, 2> carried{};
        double thinning = 0.0;
        MediumDetail detail;
        double largest = 0.0;                ///< [1/m] of a volume, over the bricks of the added balls
        glm::dvec3 source{0.0}, albedo{0.0}; ///< of a volume: [cd/m2] emitted per optical depth; [1]
    };
    const Sum* volumeOf(uint32_t place) const;
    void finishVolume(size_t group, const glm::dvec3& point);

    const DetailedMedium& medium_;
    std::vector<Sum> sums_; ///< by group
    double smooth_ = 0.0;   ///< [1/m] sum of the extinctions of balls without detail
};

} // namespace fx::render
