#include "rendering/vdb/vdb_volume.h"

#include "foundation/math/hash.h"
#include "rendering/vdb/vdb_points.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <sstream>

namespace fx::render {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr size_t kUuidAt = 21;     // [byte] after magic number, versions and the flag of offsets
constexpr size_t kUuidLength = 36; // [byte]

/// An archive whose target is memory.
class MemoryArchive : public openvdb::io::Archive
{
public:
    std::string bytesOf(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata) const
    {
        std::ostringstream stream(std::ios_base::binary);
        Archive::write(stream, grids, true, metadata);
        return std::move(stream).str();
    }
};

/// OpenVDB puts random digits into the header. They become a hash of the content, so that equal content gives
/// equal files.
void replaceUuid(std::string& io)
{
    if (io.size() < kUuidAt + kUuidLength || io[kUuidAt + 8] != '-' || io[kUuidAt + 23] != '-')
        return;
    std::fill_n(io.begin() + kUuidAt, kUuidLength, '0');
    const auto high = static_cast<unsigned long long>(base::hashBytes(1, io.data(), io.size()));
    const auto low = static_cast<unsigned long long>(base::hashBytes(2, io.data(), io.size()));
    std::array<char, kUuidLength + 1> text{};
    std::snprintf(text.data(), text.size(), "%08llx-%04llx-8%03llx-8%03llx-%012llx", high >> 32,
                  high >> 16 & 0xFFFF, high & 0xFFF, low >> 48 & 0xFFF, low & 0xFFFF'FFFF'FFFF);
    std::copy_n(text.begin(), kUuidLength, io.begin() + kUuidAt);
}

template <class Grid>
typename Grid::Ptr makeGrid(const char* name, const char* unit, double voxelSize)
{
    auto grid = Grid::create();
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
    grid->insertMeta("unit", openvdb::StringMetadata(unit));
    return grid;
}

/// Adds the voxels of a block that have medium.
template <class Grid, class ValueOf>
void addLeaf(Grid& grid, const VoxelBlock& block, ValueOf&& valueOf)
{
    using Leaf = typename Grid::TreeType::LeafNodeType;
    static_assert(Leaf::SIZE == kBlockVoxels);
    auto* const leaf = grid.tree().touchLeaf({block.origin.x, block.origin.y, block.origin.z});
    for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
        if (block.density[v] > 0.0f)
            leaf->setValueOn(openvdb::Index(v), valueOf(v));
}

float magnitudeOf(float value)
{
    return std::abs(value);
}

float magnitudeOf(const openvdb::Vec3s& value)
{
    return std::max({std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
}

template <class Grid>
bool fitsHalf(const Grid& grid)
{
    for (auto value = grid.cbeginValueOn(); value; ++value)
        if (!(magnitudeOf(*value) <= kLargestHalf))
            return false;
    return true;
}

} // namespace

struct VdbVolume::Grids
{
    explicit Grids(double size)
        : voxelSize(size), density(makeGrid<openvdb::FloatGrid>("density", "1/m", size)),
          temperature(makeGrid<openvdb::FloatGrid>("temperature", "K", size)),
          flame(makeGrid<openvdb::FloatGrid>("flame", "cd/m3", size)),
          flameRate(makeGrid<openvdb::FloatGrid>("flame_rate", "1/s", size)),
          velocity(makeGrid<openvdb::Vec3SGrid>("v", "m/s", size)),
          albedo(makeGrid<openvdb::Vec3SGrid>("Cd", "1", size))
    {
        density->setGridClass(openvdb::GRID_FOG_VOLUME);
        velocity->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    }

    double voxelSize;
    openvdb::FloatGrid::Ptr density, temperature, flame, flameRate;
    openvdb::Vec3SGrid::Ptr velocity, albedo;
    openvdb::GridBase::Ptr points; ///< null: none
};

std::string vdbVersion()
{
    return openvdb::getLibraryVersionString();
}

base::Status checkVdb()
{
    return {};
}

VdbVolume::VdbVolume(double voxelSize)
{
    openvdb::initialize();
    grids_ = std::make_unique<Grids>(voxelSize);
}

VdbVolume::~VdbVolume() = default;

void VdbVolume::add(std::span<const VoxelBlock> blocks)
{
    for (const VoxelBlock& block : blocks) {
        if (std::ranges::none_of(block.density, [](float density) { return density > 0.0f; }))
            continue;
        addLeaf(*grids_->density, block, [&](size_t v) { return block.density[v]; });
        addLeaf(*grids_->temperature, block, [&](size_t v) { return block.temperature[v]; });
        addLeaf(*grids_->flame, block, [&](size_t v) { return block.flame[v]; });
        addLeaf(*grids_->flameRate, block, [&](size_t v) { return block.flameRate[v]; });
        addLeaf(*grids_->velocity, block, [&](size_t v) {
            const glm::vec3& velocity = block.velocity[v];
            return openvdb::Vec3s(velocity.x, velocity.y, velocity.z);
        });
        addLeaf(*grids_->albedo, block, [&](size_t v) {
            const glm::vec3& albedo = block.albedo[v];
            return openvdb::Vec3s(albedo.x, albedo.y, albedo.z);
        });
    }
}

void VdbVolume::addPoints(std::span<const VoxelBall> balls, bool areMedium)
{
    grids_->points = makePoints(balls, grids_->voxelSize, areMedium);
}

uint64_t VdbVolume::voxels() const
{
    return grids_->density->activeVoxelCount();
}

base::Result<std::string> VdbVolume::encode(const VdbMetadata& metadata, bool half) const
try {
    openvdb::MetaMap map;
    for (const auto& [name, value] : metadata) {
        if (const auto* text = std::get_if<std::string>(&value))
            map.insertMeta(name, openvdb::StringMetadata(*text));
        else if (const auto* number = std::get_if<double>(&value))
            map.insertMeta(name, openvdb::DoubleMetadata(*number));
        else
            map.insertMeta(name, openvdb::Int64Metadata(std::get<int64_t>(value)));
    }
    const Grids& g = *grids_;
    g.density->setSaveFloatAsHalf(half && fitsHalf(*g.density));
    g.temperature->setSaveFloatAsHalf(half && fitsHalf(*g.temperature));
    g.flame->setSaveFloatAsHalf(half && fitsHalf(*g.flame));
    g.flameRate->setSaveFloatAsHalf(half && fitsHalf(*g.flameRate));
    g.velocity->setSaveFloatAsHalf(half && fitsHalf(*g.velocity));
    g.albedo->setSaveFloatAsHalf(half && fitsHalf(*g.albedo));
    openvdb::GridCPtrVec grids{g.density, g.temperature, g.flame, g.flameRate, g.velocity, g.albedo};
    if (g.points)
        grids.push_back(g.points);
    std::string bytes = MemoryArchive().bytesOf(grids, map);
    replaceUuid(bytes);
    return bytes;
} catch (const std::bad_alloc&) {
    return base::Status(base::Code::OutOfMemory, "not enough memory for an OpenVDB file; use larger voxels");
} catch (const std::exception& error) {
    return base::Status(base::Code::Internal, std::string("OpenVDB: ") + error.what());
}

} // namespace fx::render
