#include "fxsdk/cli/scene/field_cache.h"

#include "foundation/math/hash.h"
#include "fxsdk/cli/support/atomic_file.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace fx::cli {
namespace {

/// What a file begins with; values follow.
struct Header
{
    char magic[8];     ///< "fxfield", 0
    uint32_t version;  ///< sim::kFieldVersion
    uint32_t nodes[3]; ///< along each axis
    uint64_t mesh;     ///< hash of triangles, place and size of cells
    uint64_t field;    ///< sim::DistanceField::hash()
};
static_assert(sizeof(Header) == 40 && std::has_unique_object_representations_v<Header>);

uint64_t hashOf(const sim::TriangleMesh& mesh, float cellSize)
{
    uint64_t hash = base::hashBytes(sim::kFieldVersion, &mesh.origin, sizeof mesh.origin);
    hash = base::hashBytes(hash, &cellSize, sizeof cellSize);
    hash = base::hashWord(hash, mesh.indices.size());
    hash = base::hashBytes(hash, mesh.positions.data(), mesh.positions.size_bytes());
    return base::hashBytes(hash, mesh.indices.data(), mesh.indices.size_bytes());
}

/// What the file of a field begins with, but for the hash of the field.
Header headerOf(const sim::TriangleMesh& mesh, float cellSize, const sim::DistanceGrid& grid)
{
    return {{'f', 'x', 'f', 'i', 'e', 'l', 'd', 0},
            sim::kFieldVersion,
            {grid.nodes.x, grid.nodes.y, grid.nodes.z},
            hashOf(mesh, cellSize),
            0};
}

/// Null when `file` is not a regular file that holds exactly what `wanted` describes.
std::shared_ptr<const sim::DistanceField> read(const std::filesystem::path& file, const Header& wanted,
                                               const glm::dvec3& origin, const sim::DistanceGrid& grid,
                                               std::pmr::memory_resource* memory)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)))
        return nullptr;
    if (std::filesystem::file_size(file, error) != sizeof(Header) + grid.count() * sizeof(float) || error)
        return nullptr;
    std::ifstream in(file, std::ios::binary);
    Header header{};
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    const uint64_t hash = std::exchange(header.field, 0);
    if (!in || std::memcmp(&header, &wanted, sizeof header) != 0)
        return nullptr;
    std::pmr::vector<float> values(grid.count(), memory);
    in.read(reinterpret_cast<char*>(values.data()), std::streamsize(grid.count() * sizeof(float)));
    if (!in)
        return nullptr;
    auto field = sim::DistanceField::restore(origin, grid, values, memory);
    return field && field->hash() == hash ? field : nullptr;
}

/// Does nothing where it cannot be done.
void write(const std::filesystem::path& file, Header header, const sim::DistanceField& field)
{
    std::error_code error;
    const std::filesystem::file_status there = std::filesystem::symlink_status(file, error);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        return; // the file of another program
    header.field = field.hash();
    AtomicFile out(file);
    const std::span<const float> values = field.values();
    if (out.open() && out.write({reinterpret_cast<const char*>(&header), sizeof header}) &&
        out.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()}))
        static_cast<void>(out.commit(false)); // a damaged file is found out by its hash
}

} // namespace

std::filesystem::path fieldFileOf(const std::filesystem::path& meshFile, const sim::TriangleMesh& mesh,
                                  float cellSize)
{
    const glm::vec3 first = mesh.positions.empty() ? glm::vec3(0.0f) : mesh.positions.front();
    uint64_t hash = base::hashBytes(0, &cellSize, sizeof cellSize);
    hash = base::hashBytes(hash, &first, sizeof first); // differs where a mesh stands elsewhere
    char suffix[32];
    std::snprintf(suffix, sizeof suffix, ".%04x.fxfield", unsigned(hash & 0xFFFF));
    return meshFile.string() + suffix;
}

base::Result<std::shared_ptr<const sim::DistanceField>> fieldOf(const sim::TriangleMesh& mesh, float cellSize,
                                                                const std::filesystem::path& file,
                                                                base::TaskRunner& tasks,
                                                                std::pmr::memory_resource* memory)
{
    if (file.empty())
        return sim::DistanceField::build(mesh, cellSize, tasks, memory);
    const base::Result<sim::DistanceGrid> grid = sim::DistanceField::plan(mesh, cellSize);
    if (!grid)
        return grid.status();
    const Header header = headerOf(mesh, cellSize, *grid);
    if (auto kept = read(file, header, mesh.origin, *grid, memory))
        return kept;
    auto made = sim::DistanceField::build(mesh, cellSize, tasks, memory);
    if (made)
        write(file, header, **made);
    return made;
}

} // namespace fx::cli
