#include "rendering/vdb/vdb_reader.h"

#include "rendering/vdb/vdb_points.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <type_traits>

namespace fx::render {
namespace {

using base::Code;
using base::Status;

constexpr int kFarthest = 1 << 28;   // [voxel] of the farthest voxel from the origin
constexpr uint64_t kLeastShare = 64; // a tree in memory is at most so many times as large as in the file:
                                     // 2 KiB of a leaf for the 64 bytes of its mask, rounded up

/// Refusal of a part of a file.
struct Refused
{
    Status status;
};

[[noreturn]] void refuse(Code code, const std::string& message)
{
    throw Refused{{code, message}};
}

std::string quoted(const std::string& name)
{
    return "\"" + name + "\"";
}

std::string classOf(const openvdb::GridBase& grid)
{
    const std::string name = openvdb::GridBase::gridClassToString(grid.getGridClass());
    return grid.valueType() + (name == "unknown" ? "" : ", " + name);
}

/// A file whose grids are known by name, type and metadata, without their trees.
class OpenFile
{
public:
    explicit OpenFile(const std::string& path) : file_(path)
    {
        file_.open(/*delayLoad=*/false);
        bytes_ = std::filesystem::file_size(path);
        headers_ = file_.readAllGridMetadata();
    }

    /// What is there, for messages.
    std::string list() const
    {
        std::string text;
        for (const auto& grid : *headers_)
            text += (text.empty() ? "" : ", ") + quoted(grid->getName()) + " (" + classOf(*grid) + ")";
        return text.empty() ? "none" : text;
    }

    /// A number of the metadata of the file.
    std::optional<double> number(const char* name) const
    {
        const auto found = file_.getMetadata()->getMetadata<openvdb::DoubleMetadata>(name);
        return found ? std::optional(found->value()) : std::nullopt;
    }

    /// @param chosen by the user; empty: the first of `usual` that is there
    /// @return null: none of `usual` is there
    openvdb::GridBase::ConstPtr find(const std::string& chosen, std::initializer_list<const char*> usual,
                                     const char* option) const
    {
        const auto named = [&](const std::string& name) -> openvdb::GridBase::ConstPtr {
            for (const auto& grid : *headers_)
                if (grid->getName() == name)
                    return grid;
            return nullptr;
        };
        if (!chosen.empty()) {
            if (auto grid = named(chosen))
                return grid;
            refuse(Code::NotFound,
                   "found no grid " + quoted(chosen) + " for " + option + "; grids: " + list());
        }
        for (const char* name : usual)
            if (auto grid = named(name))
                return grid;
        return nullptr;
    }

    /// Reads a tree, after the type and the sizes that the file states have been checked.
    template <class Grid>
    typename Grid::Ptr read(const openvdb::GridBase& header, const VdbReadOptions& options)
    {
        const std::string name = header.getName();
        if (header.type() != Grid::gridType())
            refuse(Code::Schema, "grid " + quoted(name) + " is a " + header.type() + "; expected " +
                                     Grid::gridType() + "; grids: " + list());
        checkStated(header, "file_voxel_count", options.maxVoxels, "voxels");
        checkStated(header, "file_mem_bytes", bytes_ * kLeastShare, "bytes, more than the file can hold");
        auto grid = openvdb::gridPtrCast<Grid>(file_.readGrid(name));
        if (!grid)
            refuse(Code::Parse, "grid " + quoted(name) + " has no tree");
        if (!grid->transform().isLinear())
            refuse(Code::Schema, "grid " + quoted(name) + " has a frustum transform (" +
                                     grid->transform().mapType() + "); resample it to cells of equal size");
        return grid;
    }

private:
    static void checkStated(const openvdb::GridBase& header, const char* item, uint64_t most,
                            const char* what)
    {
        const auto stated = header.getMetadata<openvdb::Int64Metadata>(item);
        if (stated && (stated->value() < 0 || uint64_t(stated->value()) > most))
            refuse(Code::TooLarge, "grid " + quoted(header.getName()) + " states " +
                                       std::to_string(stated->value()) + " " + what + "; allowed are " +
                                       std::to_string(most));
    }

    openvdb::io::File file_;
    uint64_t bytes_ = 0;
    openvdb::GridPtrVecPtr headers_;
};

/// Of the grid of densities: which voxels have how much.
class DensityReader
{
public:
    DensityReader(const openvdb::FloatGrid& grid, const VdbReadOptions& options)
        : grid_(grid), options_(options), isLevelSet_(grid.getGridClass() == openvdb::GRID_LEVEL_SET)
    {
        const openvdb::Vec3d side = grid.voxelSize();
        voxel_ = std::min({side[0], side[1], side[2]});
    }

    void read(MediumGrid& out)
    {
        findBlocks(out);
        out.density.assign(out.blocks.size() * size_t(kBlockVoxels), 0.0f);
        uint64_t dropped = 0;
        forEach([&](const openvdb::CoordBBox& box, float value) {
            const float density = densityOf(value);
            if (!(density >= 0.0f && std::isfinite(density))) {
                dropped += box.volume();
                return;
            }
            fill(box, density, out);
        });
        if (dropped > 0)
            out.warnings.push_back(std::to_string(dropped) + " voxels of " + quoted(grid_.getName()) +
                                   " are negative or not finite; taken as 0");
    }

private:
    /// Calls `visit` with the box and the value of each tile and voxel that may have medium.
    template <class Visit>
    void forEach(Visit&& visit) const
    {
        const auto go = [&](auto iterator) {
            for (; iterator; ++iterator) {
                const float value = *iterator;
                if (isLevelSet_ ? !(value < 0.5 * voxel_) : value == 0.0f)
                    continue;
                openvdb::CoordBBox box;
                iterator.getBoundingBox(box);
                visit(box, value);
            }
        };
        if (isLevelSet_)
            go(grid_.tree().cbeginValueAll());
        else
            go(grid_.tree().cbeginValueOn());
    }

    /// Counts before anything is allocated for voxels.
    void findBlocks(MediumGrid& out)
    {
        const uint64_t mostBlocks =
            std::max<uint64_t>(options_.maxBytes / (uint64_t(kBlockVoxels) * kBytesPerVoxel), 1);
        uint64_t voxels = 0;
        std::map<std::array<int, 3>, size_t> found;
        forEach([&](const openvdb::CoordBBox& box, float) {
            for (int a = 0; a < 3; ++a)
                if (box.min()[a] < -kFarthest || box.max()[a] > kFarthest)
                    refuse(Code::TooLarge, "grid " + quoted(grid_.getName()) + " reaches farther than " +
                                               std::to_string(kFarthest) + " voxels from its origin");
            voxels += box.volume();
            if (voxels > options_.maxVoxels)
                refuse(Code::TooLarge, "grid " + quoted(grid_.getName()) + " has more than " +
                                           std::to_string(options_.maxVoxels) + " voxels; see --max-voxels");
            const openvdb::Coord low = box.min() & ~(kBlockSide - 1);
            for (int x = low[0]; x <= box.max()[0]; x += kBlockSide)
                for (int y = low[1]; y <= box.max()[1]; y += kBlockSide)
                    for (int z = low[2]; z <= box.max()[2]; z += kBlockSide)
                        found.try_emplace({x, y, z}, 0);
            if (found.size() > mostBlocks)
                refuse(Code::TooLarge, "grid " + quoted(grid_.getName()) + " has voxels in more than " +
                                           std::to_string(mostBlocks) + " blocks of 8x8x8; see --max-memory");
        });
        for (auto& [origin, number] : found) {
            number = out.blocks.size();
            out.blocks.emplace_back(origin[0], origin[1], origin[2]);
        }
        numbers_ = std::move(found);
    }

    void fill(const openvdb::CoordBBox& box, float density, MediumGrid& io)
    {
        for (int x = box.min()[0]; x <= box.max()[0]; ++x)
            for (int y = box.min()[1]; y <= box.max()[1]; ++y)
                for (int z = box.min()[2]; z <= box.max()[2]; ++z) {
                    constexpr int kIn = kBlockSide - 1;
                    const std::array<int, 3> origin{x & ~kIn, y & ~kIn, z & ~kIn};
                    if (origin != lastOrigin_ || lastNumber_ == kNone) {
                        lastOrigin_ = origin;
                        lastNumber_ = numbers_.at(origin);
                    }
                    io.density[lastNumber_ * size_t(kBlockVoxels) + voxelInBlock(x & kIn, y & kIn, z & kIn)] =
                        density;
                }
    }

    /// A level set has the share of the voxel behind a plane at this distance, perpendicular to an axis.
    float densityOf(float value) const
    {
        const double share = isLevelSet_ ? std::clamp(0.5 - double(value) / voxel_, 0.0, 1.0) : double(value);
        return float(std::isnan(value) ? double(value) : options_.densityScale * share);
    }

    static constexpr uint64_t kBytesPerVoxel = 4 * sizeof(float) + 2 * sizeof(glm::vec3);
    static constexpr size_t kNone = ~size_t(0);

    const openvdb::FloatGrid& grid_;
    const VdbReadOptions& options_;
    bool isLevelSet_;
    double voxel_ = 1.0; ///< [unit of the file] side
    std::map<std::array<int, 3>, size_t> numbers_;
    std::array<int, 3> lastOrigin_{};
    size_t lastNumber_ = kNone;
};

/// Calls `visit` with the index and the place in index space of `other` of each voxel that has medium.
template <class Visit>
void forEachVoxel(const MediumGrid& medium, const openvdb::math::Transform& lattice,
                  const openvdb::math::Transform& other, Visit&& visit)
{
    const bool isSame = lattice == other;
    for (size_t b = 0; b < medium.blocks.size(); ++b)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v) {
            const size_t at = b * size_t(kBlockVoxels) + v;
            if (!(medium.density[at] > 0.0f))
                continue;
            const glm::ivec3 o = medium.blocks[b];
            const openvdb::Vec3d index(o.x + int(v >> 6), o.y + int(v >> 3 & 7), o.z + int(v & 7));
            visit(at, isSame ? index : other.worldToIndex(lattice.indexToWorld(index)));
        }
}

std::vector<float> readScalars(const openvdb::FloatGrid& grid, const openvdb::math::Transform& lattice,
                               double scale, float low, float high, MediumGrid& io)
{
    std::vector<float> values(io.density.size(), 0.0f);
    const auto accessor = grid.getConstAccessor();
    uint64_t dropped = 0;
    forEachVoxel(io, lattice, grid.transform(), [&](size_t at, const openvdb::Vec3d& place) {
        const float value = float(scale * double(openvdb::tools::BoxSampler::sample(accessor, place)));
        const bool isGood = value >= low && value <= high;
        values[at] = isGood ? value : 0.0f;
        dropped += isGood ? 0 : 1;
    });
    if (dropped > 0)
        io.warnings.push_back(std::to_string(dropped) + " voxels of " + quoted(grid.getName()) +
                              (low < 0.0f ? " are outside of their range; taken as 0"
                                          : " are negative or not finite; taken as 0"));
    return values;
}

std::vector<glm::vec3> readVectors(const openvdb::Vec3SGrid& grid, const openvdb::math::Transform& lattice,
                                   double scale, float low, float high, MediumGrid& io)
{
    std::vector<glm::vec3> values(io.density.size(), glm::vec3(0.0f));
    const auto accessor = grid.getConstAccessor();
    const bool isStaggered = grid.getGridClass() == openvdb::GRID_STAGGERED;
    uint64_t dropped = 0;
    forEachVoxel(io, lattice, grid.transform(), [&](size_t at, const openvdb::Vec3d& place) {
        const openvdb::Vec3s value = isStaggered
                                         ? openvdb::tools::StaggeredBoxSampler::sample(accessor, place)
                                         : openvdb::tools::BoxSampler::sample(accessor, place);
        const glm::dvec3 scaled = scale * glm::dvec3(value[0], value[1], value[2]);
        bool isGood = true;
        for (int a = 0; a < 3; ++a)
            isGood = isGood && scaled[a] >= double(low) && scaled[a] <= double(high);
        values[at] = isGood ? glm::vec3(scaled) : glm::vec3(0.0f);
        dropped += isGood ? 0 : 1;
    });
    if (dropped > 0)
        io.warnings.push_back(std::to_string(dropped) + " voxels of " + quoted(grid.getName()) +
                              " are outside of their range; taken as 0");
    return values;
}

void readLattice(const openvdb::math::Transform& transform, double scale, MediumGrid& out)
{
    const auto vector = [&](const openvdb::Vec3d& v) { return scale * glm::dvec3(v[0], v[1], v[2]); };
    out.origin = vector(transform.indexToWorld(openvdb::Vec3d(0.0)));
    for (int a = 0; a < 3; ++a) {
        openvdb::Vec3d step(0.0);
        step[a] = 1.0;
        out.axes[a] = vector(transform.indexToWorld(step)) - out.origin;
    }
    const double volume = out.voxelVolume();
    if (!(volume > 0.0 && std::isfinite(volume)) ||
        !std::isfinite(out.origin.x + out.origin.y + out.origin.z))
        refuse(Code::Parse, "the transform has voxels without a volume");
}

/// Balls beside the voxels, which fx export --balls-below writes. Points of other programs have no attributes
/// of a medium, and are left out.
void readBalls(const openvdb::GridBase& grid, const VdbReadOptions& options, MediumGrid& io)
{
    // Luminance is flame over extinction.
    const PointScales scales{options.lengthScale, options.densityScale, options.temperatureScale,
                             options.flameScale / options.densityScale};
    uint64_t dropped = 0;
    try {
        io.balls = ballsOfPoints(grid, scales, dropped);
    } catch (const TooManyPoints&) {
        refuse(Code::TooLarge, "grid " + quoted(grid.getName()) + " has more than " +
                                   std::to_string(kMostGridBalls) +
                                   " balls of medium; export it with a smaller --balls-below");
    }
    std::ranges::stable_sort(io.balls, [](const VoxelBall& a, const VoxelBall& b) {
        return std::pair(a.instance, a.id) < std::pair(b.instance, b.id);
    });
    if (dropped > 0)
        io.warnings.push_back(std::to_string(dropped) + " points of " + quoted(grid.getName()) +
                              " have numbers out of their range; left out");
}

double anisotropyOf(const OpenFile& file, const VdbReadOptions& options, MediumGrid& io)
{
    const double stated = options.anisotropy.value_or(file.number("anisotropy").value_or(0.0));
    if (std::abs(stated) <= 1.0)
        return std::clamp(stated, -kMostAnisotropy, kMostAnisotropy);
    io.warnings.push_back("the anisotropy " + std::to_string(stated) +
                          " of the file is no mean cosine; taken as 0");
    return 0.0;
}

MediumGrid readGrids(const std::string& path, const VdbReadOptions& options)
{
    OpenFile file(path);
    const auto header = file.find(options.density, {"density"}, "--density");
    if (!header)
        refuse(Code::NotFound, "found no grid \"density\"; name one by --density; grids: " + file.list());
    const auto density = file.read<openvdb::FloatGrid>(*header, options);
    const openvdb::math::Transform& lattice = density->transform();
    MediumGrid medium;
    readLattice(lattice, options.lengthScale, medium);
    medium.anisotropy = anisotropyOf(file, options, medium);
    DensityReader(*density, options).read(medium);
    constexpr float kMost = std::numeric_limits<float>::max();
    if (const auto found = file.find(options.temperature, {"temperature"}, "--temperature"))
        medium.temperature = readScalars(*file.read<openvdb::FloatGrid>(*found, options), lattice,
                                         options.temperatureScale, 0.0f, kMost, medium);
    if (const auto found = file.find(options.flame, {"flame", "heat", "flames"}, "--flame"))
        medium.flame = readScalars(*file.read<openvdb::FloatGrid>(*found, options), lattice,
                                   options.flameScale, 0.0f, kMost, medium);
    if (const auto found = file.find("", {"flame_rate"}, ""))
        medium.flameRate = readScalars(*file.read<openvdb::FloatGrid>(*found, options), lattice, 1.0,
                                       -base::kMostVolumeRate, base::kMostVolumeRate, medium);
    if (const auto found = file.find(options.color, {"Cd", "color"}, "--color"))
        medium.albedo =
            readVectors(*file.read<openvdb::Vec3SGrid>(*found, options), lattice, 1.0, 0.0f, 1.0f, medium);
    constexpr float kFast = 1e9f; // [m/s]
    if (const auto found = file.find(options.velocity, {"v", "vel", "velocity"}, "--velocity"))
        medium.velocity = readVectors(*file.read<openvdb::Vec3SGrid>(*found, options), lattice,
                                      options.lengthScale, -kFast, kFast, medium);
    using Points = openvdb::points::PointDataGrid;
    if (const auto found = file.find("", {"points"}, ""); found && found->type() == Points::gridType())
        readBalls(*file.read<Points>(*found, options), options, medium);
    return medium;
}

} // namespace

base::Result<MediumGrid> readVdb(const std::string& path, const VdbReadOptions& options)
try {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        return Status(Code::NotFound, path + ": there is no such file");
    openvdb::initialize();
    return readGrids(path, options);
} catch (const Refused& refused) {
    return Status(refused.status.code(), path + ": " + refused.status.message());
} catch (const std::bad_alloc&) {
    return Status(Code::OutOfMemory, path + ": reading takes more memory than allowed; see --max-memory");
} catch (const std::length_error&) {
    return Status(Code::Parse, path + ": a size in the file is damaged");
} catch (const std::exception& failure) {
    return Status(Code::Parse, path + ": OpenVDB: " + failure.what());
}

} // namespace fx::render
