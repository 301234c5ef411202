#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/particle_rows/packed_rows.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/math/half.h"
#include "foundation/simd/instruction_set.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/particle_rows/packed_rows.h"
#include "rendering/particle_rows/packed_tile.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

// Plain loops, which the compiler turns into the instructions of each target.

int32_t exponentOf(float x)
{
    return int32_t(std::bit_cast<uint32_t>(x) >> 23 & 255u) - 127;
}
float powerOfTwo(int32_t e)
{
    return std::bit_cast<float>(uint32_t(e + 127) << 23);
}
/// NaN becomes 0.
float within(float x, float most)
{
    return x > -most ? (x < most ? x : most) : (x < 0.0f ? -most : 0.0f);
}
/// To nearest; of numbers far below 2^22.
int32_t rounded(float x)
{
    return std::bit_cast<int32_t>(x + 12582912.0f) - std::bit_cast<int32_t>(12582912.0f);
}

/// Six bits of exponent, eleven of mantissa; what is not empty stays so.
uint32_t radiusCode(float radius)
{
    const float bounded = radius < 0x1.fep23f ? radius : 0x1.fep23f;
    const uint32_t bits = std::bit_cast<uint32_t>(radius > 0x1.002p-40f ? bounded : 0x1.002p-40f);
    const uint32_t code = (bits - (87u << 23) + 0x7FFu + ((bits >> 12) & 1u)) >> 12;
    return radius > 0.0f ? code : 0u;
}

void encodeSizes(const PackedTile& tile, uint32_t count, uint32_t* out)
{
    for (uint32_t i = 0; i < count; ++i)
        out[i] = radiusCode(tile.radius[i]) | base::toHalf(tile.opacity[i]) << 17;
}

void encodeColors(const PackedTile& tile, uint32_t count, uint32_t* low, uint32_t* high)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float r = std::max(within(tile.red[i], 65504.0f), 0.0f);
        const float g = std::max(within(tile.green[i], 65504.0f), 0.0f);
        const float b = std::max(within(tile.blue[i], 65504.0f), 0.0f);
        const int32_t e = std::max(exponentOf(std::max(std::max(r, g), b)), -16);
        const float scale = powerOfTwo(11 - e);
        const auto red = uint32_t(std::min(rounded(r * scale), 4095));
        const auto green = uint32_t(std::min(rounded(g * scale), 4095));
        const auto blue = uint32_t(std::min(rounded(b * scale), 4095));
        const float age = within(tile.age[i] * 2048.0f, 2047.0f);
        const auto ageCode = uint32_t(int32_t(std::max(age, 0.0f)));
        low[i] = red | green << 12 | blue << 24;
        high[i] = blue >> 8 | uint32_t(e + 16) << 4 | tile.turn[i] << 9 | ageCode << 21;
    }
}

/// Mantissas are multiples of 16 where the turn, which would hold the rest of them, is the angle.
void encodeVelocities(PackedTile& tile, uint32_t count, bool hasAngle, uint32_t* out)
{
    const int32_t step = hasAngle ? 16 : 1;
    const float share = hasAngle ? 0.0625f : 1.0f;
    const int32_t most = 8192 - step;
    const uint32_t kept = hasAngle ? ~0u : 0u;
    for (uint32_t i = 0; i < count; ++i) {
        const float x = within(tile.velocityX[i], 262080.0f);
        const float y = within(tile.velocityY[i], 262080.0f);
        const float z = within(tile.velocityZ[i], 262080.0f);
        const float largest = std::max(std::max(std::abs(x), std::abs(y)), std::abs(z));
        const int32_t e = std::max(exponentOf(largest), -14);
        const float scale = powerOfTwo(11 - e) * share;
        const auto mx = uint32_t(std::max(std::min(rounded(x * scale) * step + 4096, most), 0));
        const auto my = uint32_t(std::max(std::min(rounded(y * scale) * step + 4096, most), 0));
        const auto mz = uint32_t(std::max(std::min(rounded(z * scale) * step + 4096, most), 0));
        out[i] = mx >> 4 | (my >> 4) << 9 | (mz >> 4) << 18 | uint32_t(e + 14) << 27;
        const uint32_t rest = (mx & 15u) | (my & 15u) << 4 | (mz & 15u) << 8;
        tile.turn[i] = (tile.turn[i] & kept) | (rest & ~kept);
    }
}

void encodeAngles(PackedTile& tile, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float turns = within(tile.angle[i] * 0.159154943f, 1e9f);
        const float part = turns - std::floor(turns);
        tile.turn[i] = uint32_t(rounded(part * 4096.0f)) & 4095u;
    }
}

void encodePairs(const float* a, const float* b, uint32_t count, uint32_t* out)
{
    for (uint32_t i = 0; i < count; ++i)
        out[i] = (uint32_t(rounded(within(a[i], 1.0f) * 32767.0f)) & 0xFFFFu) |
                 uint32_t(rounded(within(b[i], 1.0f) * 32767.0f)) << 16;
}

void decodeColors(const uint64_t* colors, uint32_t count, PackedTile& out)
{
    const auto asFloat = [](uint64_t half) {
        return (half & 0x8000u) != 0 ? 0.0f : std::bit_cast<float>(uint32_t(half & 0x7FFFu) << 13) * 0x1p112f;
    };
    for (uint32_t i = 0; i < count; ++i) {
        out.red[i] = asFloat(colors[i]);
        out.green[i] = asFloat(colors[i] >> 16);
        out.blue[i] = asFloat(colors[i] >> 32);
        out.opacity[i] = asFloat(colors[i] >> 48);
    }
}

void mixColumn(const float* isBoth, const float* older, float share, uint32_t count, float* io)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float mixed = older[i] * (1.0f - share) + io[i] * share;
        io[i] = isBoth[i] > 0.0f ? mixed : io[i];
    }
}

/// What fetchParticle() does for a row.
void mixTile(PackedTile& io, const PackedTile& older, float share, float seconds, uint32_t count)
{
    float isBoth[PackedTile::kRows];
    const float back = (1.0f - share) * seconds;
    for (uint32_t i = 0; i < count; ++i) {
        const bool both = (io.age[i] >= seconds) & (older.radius[i] > 0.0f) &
                          (std::abs(older.age[i] + seconds - io.age[i]) < 0.5f * seconds);
        isBoth[i] = both ? 1.0f : 0.0f;
        const bool alive = both | (io.age[i] >= back);
        const float since = both ? 0.0f : back;
        io.radius[i] = alive ? io.radius[i] : 0.0f;
        io.x[i] -= io.velocityX[i] * since;
        io.y[i] -= io.velocityY[i] * since;
        io.z[i] -= io.velocityZ[i] * since;
        const bool isUpside = older.qx[i] * io.qx[i] + older.qy[i] * io.qy[i] + older.qz[i] * io.qz[i] +
                                  older.qw[i] * io.qw[i] <
                              0.0f;
        io.flip[i] = (both & isUpside) ? -1.0f : 1.0f;
    }
    for (float* q : {io.qx, io.qy, io.qz, io.qw})
        for (uint32_t i = 0; i < count; ++i)
            q[i] *= io.flip[i];           // the same orientation
    float frameBefore[PackedTile::kRows]; // otherwise it began anew
    for (uint32_t i = 0; i < count; ++i)
        frameBefore[i] = older.frame[i] <= io.frame[i] ? older.frame[i] : io.frame[i];
    const auto mix = [&](float* to, const float* from) { mixColumn(isBoth, from, share, count, to); };
    mix(io.x, older.x);
    mix(io.y, older.y);
    mix(io.z, older.z);
    mix(io.radius, older.radius);
    mix(io.red, older.red);
    mix(io.green, older.green);
    mix(io.blue, older.blue);
    mix(io.opacity, older.opacity);
    mix(io.velocityX, older.velocityX);
    mix(io.velocityY, older.velocityY);
    mix(io.velocityZ, older.velocityZ);
    mix(io.angle, older.angle);
    mix(io.frame, frameBefore);
    mix(io.qx, older.qx);
    mix(io.qy, older.qy);
    mix(io.qz, older.qz);
    mix(io.qw, older.qw);
}

void encodeTile(PackedTile& tile, uint32_t count, const PackedTargets& to)
{
    std::fill_n(tile.turn, count, 0u);
    if (to.hasAngle)
        encodeAngles(tile, count);
    if (to.velocity)
        encodeVelocities(tile, count, to.hasAngle, to.velocity);
    encodeSizes(tile, count, to.sizes);
    encodeColors(tile, count, to.colorLow, to.colorHigh);
    if (to.orientation[0]) {
        encodePairs(tile.qx, tile.qy, count, to.orientation[0]);
        encodePairs(tile.qz, tile.qw, count, to.orientation[1]);
    }
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(encodeTile);
HWY_EXPORT(decodeColors);
HWY_EXPORT(mixTile);

namespace {

namespace column = base::particle_column;
namespace packed = packed_column;

/// Columns that are not there have their usual values.
void load(const base::SnapshotGroup& group, uint32_t first, uint32_t count, PackedTile& out)
{
    const auto take = [&](size_t c, float* to, float otherwise) {
        if (group.has(c))
            std::copy_n(group.column(c).data() + first, count, to);
        else
            std::fill_n(to, count, otherwise);
    };
    take(column::PositionX, out.x, 0.0f);
    take(column::PositionY, out.y, 0.0f);
    take(column::PositionZ, out.z, 0.0f);
    take(column::Age, out.age, 0.0f);
    take(column::Radius, out.radius, 0.0f);
    take(column::VelocityX, out.velocityX, 0.0f);
    take(column::VelocityY, out.velocityY, 0.0f);
    take(column::VelocityZ, out.velocityZ, 0.0f);
    take(column::Angle, out.angle, 0.0f);
    take(column::Frame, out.frame, 0.0f);
    take(column::OrientationX, out.qx, 0.0f);
    take(column::OrientationY, out.qy, 0.0f);
    take(column::OrientationZ, out.qz, 0.0f);
    take(column::OrientationW, out.qw, 1.0f);
    HWY_DYNAMIC_DISPATCH(decodeColors)(group.column64(column::Color).data() + first, count, out);
}

PackedTargets targetsOf(const RowPlaces& places, std::byte* out, uint32_t first)
{
    const auto at = [&](size_t c) {
        return places[c] >= 0 ? reinterpret_cast<uint32_t*>(out) + places[c] + first : nullptr;
    };
    PackedTargets to;
    for (size_t k = 0; k < 3; ++k)
        to.position[k] = reinterpret_cast<float*>(at(packed::Position + k));
    to.sizes = at(packed::Radius);
    to.colorLow = at(packed::Color);
    to.colorHigh = at(packed::Color + 1);
    to.velocity = at(packed::Velocity);
    to.frame = reinterpret_cast<float*>(at(packed::Frame));
    to.orientation[0] = at(packed::Orientation);
    to.orientation[1] = at(packed::Orientation + 1);
    to.hasAngle = places[packed::HasAngle] >= 0;
    return to;
}

void store(PackedTile& tile, uint32_t count, const PackedTargets& to)
{
    std::copy_n(tile.x, count, to.position[0]);
    std::copy_n(tile.y, count, to.position[1]);
    std::copy_n(tile.z, count, to.position[2]);
    if (to.frame)
        std::copy_n(tile.frame, count, to.frame);
    HWY_DYNAMIC_DISPATCH(encodeTile)(tile, count, to);
}

} // namespace

uint64_t layOutPacked(const base::SnapshotGroup& group, uint64_t room, RowPlaces& out)
{
    out.fill(-1);
    const uint64_t columnWords = (room + 15) / 16 * 16;
    uint64_t words = 0;
    const auto add = [&](size_t c) {
        out[c] = int32_t(words);
        words += columnWords;
    };
    for (size_t c = packed::Position; c < packed::Velocity; ++c)
        add(c);
    if (group.has(column::VelocityX))
        add(packed::Velocity);
    if (group.has(column::Frame))
        add(packed::Frame);
    if (group.has(column::OrientationX)) {
        add(packed::Orientation);
        add(packed::Orientation + 1);
    }
    out[packed::HasAngle] = group.has(column::Angle) ? 0 : -1;
    out[packed::IsPacked] = 0;
    return words;
}

uint32_t packedRowBytes(const RowPlaces& places)
{
    uint32_t columns = 0;
    for (size_t c = 0; c < places.size(); ++c)
        columns += places[c] >= 0 && c != packed::HasAngle && c != packed::IsPacked ? 1 : 0;
    return 4 * columns;
}

void packRows(const base::SnapshotGroup& group, uint32_t first, uint32_t count, const RowPlaces& places,
              std::byte* out)
{
    base::applyInstructionSetLimit();
    PackedTile tile;
    for (uint32_t done = 0; done < count; done += PackedTile::kRows) {
        const uint32_t rows = std::min(count - done, PackedTile::kRows);
        load(group, first + done, rows, tile);
        store(tile, rows, targetsOf(places, out, first + done));
    }
}

void packRowsBetween(const base::SnapshotGroup& newer, const base::SnapshotGroup& older,
                     const RowMoment& moment, uint32_t first, uint32_t count, const RowPlaces& places,
                     std::byte* out)
{
    base::applyInstructionSetLimit();
    PackedTile tile;
    PackedTile before;
    for (uint32_t done = 0; done < count; done += PackedTile::kRows) {
        const uint32_t from = first + done;
        const uint32_t rows = std::min(count - done, PackedTile::kRows);
        const uint32_t known = std::min(rows, std::max(older.count(), from) - from);
        load(newer, from, rows, tile);
        load(older, std::min(from, older.count()), known, before);
        before.fillFrom(known, rows);
        if (!older.has(column::VelocityX)) { // there is nothing to mix with
            std::copy_n(tile.velocityX, rows, before.velocityX);
            std::copy_n(tile.velocityY, rows, before.velocityY);
            std::copy_n(tile.velocityZ, rows, before.velocityZ);
        }
        if (!older.has(column::Angle))
            std::copy_n(tile.angle, rows, before.angle);
        if (!older.has(column::Frame))
            std::copy_n(tile.frame, rows, before.frame);
        HWY_DYNAMIC_DISPATCH(mixTile)(tile, before, moment.share, moment.seconds, rows);
        store(tile, rows, targetsOf(places, out, from));
    }
}

} // namespace fx::render
#endif
