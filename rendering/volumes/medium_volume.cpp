#include "rendering/volumes/medium_volume.h"

#include "foundation/math/half.h"
#include "foundation/math/hash.h"
#include "foundation/math/signed_half.h"
#include "rendering/optics/black_body.h"
#include "rendering/volumes/escape_depth.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::render {

namespace {

constexpr int kSide = base::kVolumeBrickSide;
constexpr size_t kVoxels = base::kVolumeBrickVoxels;

glm::ivec3 voxelInBrick(size_t v)
{
    return {int(v % 8), int(v / 8 % 8), int(v / 64)};
}

glm::dvec3 velocityOr(const glm::dvec3& momentum, double weight, const glm::dvec3& other)
{
    glm::dvec3 velocity;
    for (int a = 0; a < 3; ++a)
        velocity[a] = formula64::fxFlowVelocity(momentum[a], weight, other[a]);
    return velocity;
}

/// Factor of the density after a time [s]. @param growth weight times divergence
double densityOf(double seconds, double growth, double weight)
{
    return formula64::fxFlowDensity(seconds, formula64::fxFlowVelocity(growth, weight, 0.0));
}

glm::dvec4 shifted(const std::array<glm::dvec4, 4>& v, double t)
{
    glm::dvec4 out;
    for (int c = 0; c < 4; ++c)
        out[c] = formula64::fxFlowShift(v[0][c], v[1][c], v[2][c], v[3][c], t);
    return out;
}

float sumOf(const glm::vec3& light)
{
    return light.x + light.y + light.z;
}

template <class T>
uint64_t hashOf(uint64_t hash, const std::vector<T>& values)
{
    return base::hashBytes(hash, values.data(), values.size() * sizeof(T));
}

/// Bricks of voxels of twice the side that voxels with medium reach, ascending.
/// @param isEmpty of the voxel with an index in the arrays
template <class IsEmpty>
std::vector<glm::ivec3> halvedBricks(const std::vector<glm::ivec3>& own, const IsEmpty& isEmpty)
{
    std::vector<glm::ivec3> bricks;
    for (size_t b = 0; b < own.size(); ++b) {
        std::array<bool, 8> reached{}; // the last voxels also belong to the bricks behind
        for (size_t v = b * kVoxels; v < (b + 1) * kVoxels; ++v) {
            const glm::ivec3 in = isEmpty(v) ? glm::ivec3(-1) : voxelInBrick(v % kVoxels);
            for (int k = 0; k < 8 && in.x >= 0; ++k)
                reached[size_t(k)] |= ((k & 1) == 0 || in.x == kSide - 1) &&
                                      ((k & 2) == 0 || in.y == kSide - 1) &&
                                      ((k & 4) == 0 || in.z == kSide - 1);
        }
        for (int k = 0; k < 8; ++k)
            if (reached[size_t(k)]) {
                const glm::ivec3 last = own[b] * kSide + glm::ivec3(k & 1, k >> 1 & 1, k >> 2) * kSide;
                bricks.push_back({last.x >> 4, last.y >> 4, last.z >> 4});
            }
    }
    std::ranges::sort(bricks, base::isBefore);
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    return bricks;
}

} // namespace

MediumVolume::MediumVolume(const base::VoxelVolume& volume)
    : bricks_(volume.bricks), index_(volume.bricks), side_(volume.side), extinction_(volume.extinction)
{
    const size_t voxels = extinction_.size();
    scattered_.reserve(voxels);
    const bool emits = !volume.temperature.empty() || !volume.emission.empty();
    emitted_.reserve(emits ? voxels : 0);
    for (size_t v = 0; v < voxels; ++v) {
        const glm::vec3 albedo = volume.albedo.empty() ? volume.evenAlbedo : volume.albedo[v];
        scattered_.push_back(extinction_[v] * albedo);
        if (!emits)
            continue;
        glm::vec3 light = volume.emission.empty() ? glm::vec3(0.0f) : volume.emission[v];
        if (!volume.temperature.empty() && extinction_[v] > 0.0f)
            light += extinction_[v] * (1.0f - albedo) * blackBodyLuminance(volume.temperature[v]);
        emitted_.push_back(light);
    }
    if (emits)
        rate_ = volume.emissionRate;
    velocity_.reserve(volume.velocity.size());
    for (const glm::vec3& velocity : volume.velocity)
        velocity_.push_back(velocity / volume.side);
    findDivergence();
    hash_ = hashOf(hashOf(hashOf(hashOf(hashOf(3, bricks_), extinction_), scattered_), emitted_), velocity_);
    hash_ = hashOf(hash_, rate_);
    findLargest();
}

MediumVolume::MediumVolume(std::vector<glm::ivec3> bricks, float side, uint64_t hash)
    : bricks_(std::move(bricks)), index_(bricks_), side_(side), hash_(hash)
{}

void MediumVolume::findLargest()
{
    for (const float extinction : extinction_)
        largest_ = std::max(largest_, extinction);
    float most = 0.0f;
    for (const glm::vec3& light : emitted_)
        most = std::max({most, light.x, light.y, light.z});
    brightest_ = most > 0.0f ? most : 1.0f;
}

/// From the neighbors along each axis that are stored.
void MediumVolume::findDivergence()
{
    divergence_.assign(velocity_.size(), 0.0f);
    for (size_t v = 0; v < velocity_.size(); ++v) {
        const glm::ivec3 voxel = bricks_[v / kVoxels] * kSide + voxelInBrick(v % kVoxels);
        for (int a = 0; a < 3; ++a) {
            glm::ivec3 step(0);
            step[a] = 1;
            const size_t behind = voxelAt(voxel - step), ahead = voxelAt(voxel + step);
            const size_t low = behind == kNone ? v : behind, high = ahead == kNone ? v : ahead;
            const float distance = float((low == v ? 0 : 1) + (high == v ? 0 : 1));
            if (distance > 0.0f)
                divergence_[v] += (velocity_[high][a] - velocity_[low][a]) / distance;
        }
    }
}

size_t MediumVolume::voxelAt(const glm::ivec3& voxel) const
{
    const glm::ivec3 brick(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3);
    const uint32_t found = index_.find(brick);
    if (found == base::BrickIndex::kNone)
        return kNone;
    const glm::ivec3 in = voxel - kSide * brick;
    return size_t(found) * kVoxels + size_t(in.x + kSide * (in.y + kSide * in.z));
}

/// [1] Shares of the light of all voxels that are seen; none where nothing glows.
std::vector<float> MediumVolume::sharesOfLight() const
{
    if (emitted_.empty())
        return {};
    std::vector<glm::ivec3> blocks; // in their order their last coordinate rises first
    for (const glm::ivec3& brick : bricks_)
        blocks.emplace_back(brick.z, brick.y, brick.x);
    return seenShares({blocks, {kSide * kSide, kSide, 1}, extinction_, double(side_)});
}

MediumVolume MediumVolume::halved() const
{
    const auto isEmpty = [this](size_t v) {
        return extinction_[v] == 0.0f && (emitted_.empty() || emitted_[v] == glm::vec3(0.0f));
    };
    MediumVolume half(halvedBricks(bricks_, isEmpty), 2.0f * side_, base::hashWord(hash_, 2));
    const size_t voxels = half.bricks_.size() * kVoxels;
    half.extinction_.assign(voxels, 0.0f);
    half.scattered_.assign(voxels, glm::vec3(0.0f));
    half.emitted_.assign(emitted_.empty() ? 0 : voxels, glm::vec3(0.0f));
    half.rate_.assign(rate_.empty() ? 0 : voxels, 0.0f);
    half.velocity_.assign(velocity_.empty() ? 0 : voxels, glm::vec3(0.0f));
    const std::vector<float> shares = sharesOfLight();
    std::vector<float> seen(emitted_.empty() ? 0 : voxels, 0.0f); // [1/m] extinction times shares
    for (size_t v = 0; v < extinction_.size(); ++v) {
        if (isEmpty(v))
            continue;
        const glm::ivec3 from = bricks_[v / kVoxels] * kSide + voxelInBrick(v % kVoxels);
        for (int k = 0; k < 8; ++k) {
            float weight = 1.0f;
            glm::ivec3 to;
            for (int a = 0; a < 3; ++a) {
                const bool isOdd = (from[a] & 1) != 0, isSecond = (k >> a & 1) != 0;
                to[a] = (from[a] >> 1) + (isSecond ? 1 : 0);
                weight *= isOdd ? 0.25f : isSecond ? 0.0f : 0.5f;
            }
            if (weight == 0.0f)
                continue;
            const size_t at = half.voxelAt(to);
            half.extinction_[at] += weight * extinction_[v];
            half.scattered_[at] += weight * scattered_[v];
            if (!emitted_.empty()) {
                half.emitted_[at] += weight * shares[v] * emitted_[v];
                seen[at] += weight * shares[v] * extinction_[v];
                if (!rate_.empty())
                    half.rate_[at] += weight * shares[v] * sumOf(emitted_[v]) * rate_[v];
            }
        }
    }
    for (size_t v = 0; v < half.rate_.size(); ++v) {
        const float light = sumOf(half.emitted_[v]);
        half.rate_[v] = light > 0.0f ? half.rate_[v] / light : 0.0f;
    }
    for (size_t v = 0; v < seen.size(); ++v)
        if (seen[v] > 0.0f)
            half.emitted_[v] *= half.extinction_[v] / seen[v];
    for (size_t v = 0; v < half.velocity_.size(); ++v) { // from the finer voxel at the same place
        const glm::ivec3 at = half.bricks_[v / kVoxels] * kSide + voxelInBrick(v % kVoxels);
        const Flow flow = flowAt(2.0 * glm::dvec3(at));
        half.velocity_[v] = 0.5f * glm::vec3(velocityOr(flow.momentum, flow.weight, glm::dvec3(0.0)));
    }
    half.findDivergence();
    half.findLargest();
    return half;
}

/// Calls `add` with the index and the weight of each stored voxel around a place.
template <class Add>
void MediumVolume::addCorners(const glm::dvec3& place, const Add& add) const
{
    const glm::dvec3 low = glm::floor(place);
    const glm::dvec3 part = place - low;
    const glm::dvec3 first = glm::dvec3(index_.low() * kSide - 1);
    const glm::dvec3 last = glm::dvec3((index_.low() + index_.size()) * kSide);
    for (int a = 0; a < 3; ++a)
        if (!(low[a] >= first[a] && low[a] <= last[a]))
            return;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 corner(k & 1, k >> 1 & 1, k >> 2);
        double weight = 1.0;
        for (int a = 0; a < 3; ++a)
            weight *= corner[a] == 1 ? part[a] : 1.0 - part[a];
        const size_t v = voxelAt(glm::ivec3(low) + corner);
        if (v == kNone || weight == 0.0)
            continue;
        add(v, weight);
    }
}

MediumVolume::Sample MediumVolume::at(const glm::dvec3& place) const
{
    Sample sample;
    addCorners(place, [&](size_t v, double weight) {
        sample.extinction += weight * double(extinction_[v]);
        sample.scattered += weight * glm::dvec3(scattered_[v]);
        if (!emitted_.empty())
            sample.emitted += weight * glm::dvec3(emitted_[v]);
        if (!rate_.empty())
            sample.rate += weight * double(sumOf(emitted_[v])) * double(rate_[v]);
    });
    const double light = sample.emitted.x + sample.emitted.y + sample.emitted.z;
    sample.rate = light > 0.0 ? sample.rate / light : 0.0;
    return sample;
}

MediumVolume::Sample MediumVolume::shiftedAt(const glm::dvec3& place) const
{
    Sample sample = at(place);
    if (!(sample.extinction > 0.0))
        return sample;
    const glm::dvec3 low = glm::floor(place), part = place - low;
    const glm::dvec3 albedo = sample.scattered / sample.extinction;
    glm::dvec3 dimmest = sample.emitted / sample.extinction, brightest = dimmest; // S
    std::array<glm::dvec4, 4> planes{}, rows{}, taps{};                           // emitted light, extinction
    const auto isUsed = [&](int axis, int i) { return i == 1 || part[axis] > 0.0; };
    for (int z = 0; z < 4; ++z) {
        for (int y = 0; y < 4 && isUsed(2, z); ++y) {
            for (int x = 0; x < 4 && isUsed(1, y); ++x) {
                const size_t v = isUsed(0, x) ? voxelAt(glm::ivec3(low) + glm::ivec3(x, y, z) - 1) : kNone;
                const double own = v == kNone ? 0.0 : double(extinction_[v]);
                const glm::dvec3 light =
                    v == kNone || emitted_.empty() ? glm::dvec3(0.0) : glm::dvec3(emitted_[v]);
                taps[size_t(x)] = {light, own};
                if (own > 0.0 && x % 3 != 0 && y % 3 != 0 && z % 3 != 0) {
                    dimmest = glm::min(dimmest, light / own);
                    brightest = glm::max(brightest, light / own);
                }
            }
            rows[size_t(y)] = shifted(taps, part.x);
        }
        planes[size_t(z)] = shifted(rows, part.y);
    }
    const glm::dvec4 found = shifted(planes, part.z);
    sample.extinction = found.a;
    sample.emitted = glm::clamp(glm::dvec3(found), found.a * dimmest, found.a * brightest);
    sample.scattered = found.a * albedo;
    return sample;
}

MediumVolume::Corners MediumVolume::cornersAt(const glm::dvec3& place) const
{
    Corners corners;
    size_t count = 0;
    addCorners(place, [&](size_t v, double weight) {
        corners.weight[count] = weight;
        corners.extinction[count++] = double(extinction_[v]);
    });
    return corners;
}

MediumVolume::Flow MediumVolume::flowAt(const glm::dvec3& place) const
{
    Flow flow;
    addCorners(place, [&](size_t v, double weight) {
        const double own = weight * formula64::fxFlowWeight(double(extinction_[v]));
        flow.weight += own;
        flow.momentum += own * glm::dvec3(velocity_[v]);
        flow.growth += own * double(divergence_[v]);
    });
    return flow;
}

MediumVolume::Flow MediumVolume::flowAt(const glm::dvec3& place, const base::LatticeMap& toOwn) const
{
    Flow flow = flowAt(toOwn(place));
    flow.momentum /= toOwn.scale;
    return flow;
}

MediumVolume MediumVolume::between(const MediumVolume& first, const MediumVolume& second,
                                   const Moment& moment)
{
    const base::LatticeMap &toFirst = moment.toFirst, &toSecond = moment.toSecond;
    std::vector<glm::ivec3> bricks = base::bricksReached(first.bricks_, toFirst);
    const std::vector<glm::ivec3> more = base::bricksReached(second.bricks_, toSecond);
    bricks.insert(bricks.end(), more.begin(), more.end());
    std::ranges::sort(bricks, base::isBefore);
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    uint64_t hash = base::hashWord(first.hash_, second.hash_);
    for (const double number : {moment.part, moment.seconds})
        hash = base::hashWord(hash, std::bit_cast<uint64_t>(number));
    for (const base::LatticeMap* map : {&toFirst, &toSecond})
        for (const double number : {map->scale, map->offset.x, map->offset.y, map->offset.z})
            hash = base::hashWord(hash, std::bit_cast<uint64_t>(number));
    MediumVolume out(std::move(bricks), float(double(first.side_) * toFirst.scale), hash);
    const size_t voxels = out.bricks_.size() * kVoxels;
    const bool emits = !first.emitted_.empty() || !second.emitted_.empty();
    const bool moves = moment.seconds > 0.0 && first.hasVelocities() && second.hasVelocities();
    out.extinction_.resize(voxels);
    out.scattered_.resize(voxels);
    out.emitted_.resize(emits ? voxels : 0);
    const double perRate = moment.seconds / 16.0;
    const double since = moment.part * moment.seconds, until = (1.0 - moment.part) * moment.seconds;
    for (size_t v = 0; v < voxels; ++v) {
        const glm::dvec3 here(out.bricks_[v / kVoxels] * kSide + voxelInBrick(v % kVoxels));
        glm::dvec3 before = here, after = here;
        double left = 1.0, arrived = 1.0; // factors of the density
        if (moves) {
            const auto mix = [&](const auto& a, const auto& b) {
                return (1.0 - moment.part) * a + moment.part * b;
            };
            const Flow a = first.flowAt(here, toFirst), b = second.flowAt(here, toSecond);
            const glm::dvec3 mixed =
                velocityOr(mix(a.momentum, b.momentum), mix(a.weight, b.weight), glm::dvec3(0.0));
            const Flow from = first.flowAt(here - since * mixed, toFirst);
            const Flow to = second.flowAt(here + until * mixed, toSecond);
            before -= since * velocityOr(from.momentum, from.weight, mixed); // (2)
            after += until * velocityOr(to.momentum, to.weight, mixed);      // (3)
            left = densityOf(since, from.growth, from.weight);
            arrived = densityOf(-until, to.growth, to.weight);
        }
        const Sample a = first.shiftedAt(toFirst(before)), b = second.shiftedAt(toSecond(after));
        const double p = moment.part;
        out.extinction_[v] = float((1.0 - p) * left * a.extinction + p * arrived * b.extinction); // (5)
        out.scattered_[v] = glm::vec3((1.0 - p) * left * a.scattered + p * arrived * b.scattered);
        for (int c = 0; emits && c < 3; ++c)
            out.emitted_[v][c] = float(formula64::fxFlowLight((1.0 - p) * left * a.extinction, a.emitted[c],
                                                              p * arrived * b.extinction, b.emitted[c],
                                                              a.extinction, b.extinction, perRate * a.rate,
                                                              perRate * b.rate)); // (7)
    }
    out.findLargest();
    return out;
}

float MediumVolume::largestIn(const glm::ivec3& brick) const
{
    float most = 0.0f;
    for (int z = 0; z <= kSide; ++z)
        for (int y = 0; y <= kSide; ++y)
            for (int x = 0; x <= kSide; ++x)
                if (const size_t v = voxelAt(brick * kSide + glm::ivec3(x, y, z)); v != kNone)
                    most = std::max(most, extinction_[v]);
    return most;
}

std::vector<MediumVolume::Packed> MediumVolume::packed() const
{
    std::vector<Packed> voxels(extinction_.size());
    for (size_t v = 0; v < voxels.size(); ++v) {
        const glm::vec3 light = emitted_.empty() ? glm::vec3(0.0f) : emitted_[v] / brightest_;
        const glm::vec3 albedo = extinction_[v] > 0.0f ? scattered_[v] / extinction_[v] : glm::vec3(0.0f);
        uint32_t bits = 0;
        for (int c = 0; c < 3; ++c)
            bits |= uint32_t(std::lround(std::clamp(albedo[c], 0.0f, 1.0f) * 1023.0f)) << (10 * c);
        voxels[v] = {std::bit_cast<uint32_t>(extinction_[v]),
                     base::toHalf(light.x) | base::toHalf(light.y) << 16,
                     base::toHalf(light.z) | base::toSignedHalf(rate_.empty() ? 0.0f : rate_[v]) << 16, bits};
    }
    return voxels;
}

std::vector<MediumVolume::Packed> MediumVolume::packedWithVelocities() const
{
    std::vector<Packed> words = packed();
    const size_t voxels = words.size();
    words.resize(voxels + (velocity_.empty() ? 0 : voxels / 2));
    for (size_t v = 0; v < velocity_.size(); ++v) {
        const glm::vec3& u = velocity_[v];
        uint32_t* const pair = &words[voxels + v / 2][2 * (v % 2)];
        pair[0] = base::toSignedHalf(u.x) | base::toSignedHalf(u.y) << 16;
        pair[1] = base::toSignedHalf(u.z) | base::toSignedHalf(divergence_[v]) << 16;
    }
    return words;
}

} // namespace fx::render
